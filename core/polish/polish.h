#pragma once
#include "polish/coarse_space.h"
#include "snapshots/sample_queue.h"
#include "snapshots/sample_system.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// A few full-space iterations from a shape that is close to the solution, as that of a reduced
/// model is: the L-BFGS of the snapshots on one sample, seeded on two levels.
///
/// @param inverse  inverse of the Hessian on the coarse space near the start, positive definite
/// @param sample   in the caller's numbering
/// @return  in the caller's numbering; of a solve that the control cancels the lowest shape so far
[[nodiscard]] Solution polish(const SampleSystem& system, const CoarseSpace& coarse,
                              const Eigen::MatrixXf& inverse, const Sample& sample,
                              const SolveOptions& options, const SolveControl& control);

}  // namespace snapspace
