#pragma once
#include "snapshots/sample_system.h"

namespace snapspace {

/// Objectives and gradients at several displacements: one per lane, and packs on threads. A result
/// depends neither on the threads nor on the other displacements.
///
/// @param inputs     count x input_size
/// @param shapes     count x 3n, in the caller's numbering
/// @param values     count
/// @param gradients  count x 3n, in the caller's numbering
void evaluate(const SampleSystem& system, int count, const double* inputs, const double* shapes,
              double* values, double* gradients, int threads);

/// A pack of `width` samples, in single or double precision.
struct PackKind {
  int width;
  bool single;
};

/// Where a pack's results go: values and products are `count`, the others count x 3n.
struct PackResults {
  double* values;
  double* gradients;
  double* products;  ///< gradient . image
  double* images;    ///< the gradients times the seed of the inverse Hessian
};

/// What L-BFGS asks of a pack with `count` samples, for comparing packs of different widths, whose
/// results must be bitwise the same. Returns false if this processor's level has no such pack.
[[nodiscard]] bool evaluate_in_pack(const SampleSystem& system, PackKind kind, int count,
                                    const double* inputs, const double* shapes,
                                    const PackResults& results);

}  // namespace snapspace
