#pragma once
#include "polish/coarse_space.h"
#include "snapshots/interpolation_system.h"
#include "snapshots/posing_system.h"
#include "snapshots/sample_queue.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// A few full-space iterations from a shape that is close to the solution, as that of a reduced
/// model is: the L-BFGS of the snapshots on one sample, seeded on two levels.
///
/// @tparam System  PosingSystem or InterpolationSystem
/// @param inverse  inverse of the Hessian on the coarse space near the start, positive definite
/// @param sample   in the caller's numbering
/// @return  in the caller's numbering; of a solve that the control cancels the lowest shape so far
template <class System>
Solution polish(const System& system, const CoarseSpace& coarse, const Eigen::MatrixXf& inverse,
                const Sample& sample, const SolveOptions& options, const SolveControl& control);

extern template Solution polish(const PosingSystem&, const CoarseSpace&, const Eigen::MatrixXf&,
                                const Sample&, const SolveOptions&, const SolveControl&);
extern template Solution polish(const InterpolationSystem&, const CoarseSpace&,
                                const Eigen::MatrixXf&, const Sample&, const SolveOptions&,
                                const SolveControl&);

}  // namespace snapspace
