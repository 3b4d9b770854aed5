#pragma once
#include <Eigen/SparseCore>

#include "multigrid/two_grid_cycle.h"

namespace snapspace {

/// The lowest eigenvalue of cycle * A, from above: the lowest Ritz value of a few steps of
/// conjugate gradients (Saad 2003, sec. 6.7.3). One over it bounds the condition number.
[[nodiscard]] double lowest_eigenvalue(const Eigen::SparseMatrix<double>& A,
                                       const TwoGridCycle& cycle);

}  // namespace snapspace
