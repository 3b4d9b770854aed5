#pragma once
#include "snapshots/coarse_space.h"
#include "snapshots/sample_queue.h"
#include "snapshots/sample_system.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// A few full-space iterations from a shape close to the solution, such as that of a reduced model:
/// the L-BFGS of the snapshots on one sample, with a two-level seed.
///
/// @param coarse   null for the patches of the system, if it has any
/// @param sample   in the caller's numbering; after the system's input comes the inverse of the
///                 Hessian on the coarse space near the start, see `on_two_levels`
/// @return  in the caller's numbering; the lowest shape so far if the control cancels the solve
[[nodiscard]] Solution polish(const SampleSystem& system, const CoarseSpace* coarse,
                              const Sample& sample, const SolveOptions& options,
                              const SolveControl& control);

}  // namespace snapspace
