#pragma once
#include "snapshots/sample_queue.h"
#include "snapshots/sample_system.h"
#include "snapshots/soft_modes.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// Solves the samples of a queue until it is closed and empty, or the control cancels, by L-BFGS on
/// the scalar factor: one sample per lane, and a pack of lanes per thread. The result of a sample
/// does not depend on the number of threads or on which samples are solved together.
/// @param modes     deformations that the factor mistakes for stiff; may be null
/// @param expected  number of samples that will come in all; with few samples, each pack gets
///                  several threads
void solve_fast(const SampleSystem& system, const SoftModes* modes, SampleQueue& queue,
                int expected, const SolveOptions& options, SolveControl& control);

/// The same by Newton's method, one sample per thread at a time.
/// @return  conjugate gradient iterations of all samples together
long solve_newton(const SampleSystem& system, SampleQueue& queue, int expected,
                  const SolveOptions& options, const HessianOptions& hessian,
                  SolveControl& control);

}  // namespace snapspace
