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

}  // namespace snapspace
