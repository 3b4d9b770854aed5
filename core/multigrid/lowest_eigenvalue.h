#pragma once
#include <Eigen/SparseCore>

#include "multigrid/two_grid_cycle.h"

namespace snapspace {

/// Estimates the lowest eigenvalue of cycle * A from above: the lowest Ritz value after a few steps
/// of conjugate gradients (Saad 2003, sec. 6.7.3). Its inverse estimates the condition number.
[[nodiscard]] double lowest_eigenvalue(const Eigen::SparseMatrix<double>& A,
                                       const TwoGridCycle& cycle);

}  // namespace snapspace
