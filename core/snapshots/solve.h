#pragma once
#include "snapshots/sample_queue.h"
#include "snapshots/sample_system.h"
#include "snapshots/soft_modes.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// Solves the samples of a queue until it is closed and empty, or the control cancels: by L-BFGS on
/// the scalar factor, one sample per lane, threads over packs of lanes. The result of a sample does
/// not depend on the number of threads, nor on which samples are solved together.
///
/// @param modes     what the factor mistakes for stiff; may be null
/// @param expected  samples that will come in all; a few leave threads for each other
void solve_fast(const SampleSystem& system, const SoftModes* modes, SampleQueue& queue,
                int expected, const SolveOptions& options, SolveControl& control);

/// The same by Newton's method, one sample per thread at a time.
/// @return  conjugate gradient iterations of all samples together
long solve_newton(const SampleSystem& system, SampleQueue& queue, int expected,
                  const SolveOptions& options, const HessianOptions& hessian,
                  SolveControl& control);

}  // namespace snapspace
