#pragma once
#include <Eigen/SparseCore>

#include "cholesky/supernodes.h"

namespace snapspace {

/// The supernodes of A in the order with the fewest non-zeros that is worth its time: minimum
/// degree, and nested dissection as well where that leaves a dense factor. Both triangles of A and
/// its diagonal are stored; only the pattern is read.
[[nodiscard]] Supernodes analysed(const Eigen::SparseMatrix<double>& A);

/// The two halves of this, for those who have something else for matrices with dense factors.
[[nodiscard]] Supernodes by_minimum_degree(const Eigen::SparseMatrix<double>& A);
[[nodiscard]] Supernodes or_by_dissection(const Eigen::SparseMatrix<double>& A,
                                          Supernodes by_degree);

/// Whether the factor has so many entries per column that dissection is worth its time.
[[nodiscard]] bool is_dense(const Supernodes& supernodes);

}  // namespace snapspace
