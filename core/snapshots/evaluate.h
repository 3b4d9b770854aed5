#pragma once
#include "snapshots/sample_system.h"

namespace snapspace {

/// Objectives at several displacements, with their gradients: one per lane, packs on threads. What
/// comes out depends neither on the threads nor on the others.
///
/// @param inputs     count x input_size
/// @param shapes     count x 3n, in the caller's numbering
/// @param values     count
/// @param gradients  count x 3n, in the caller's numbering
void evaluate(const SampleSystem& system, int count, const double* inputs, const double* shapes,
              double* values, double* gradients, int threads);

}  // namespace snapspace
