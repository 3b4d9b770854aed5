#pragma once
#include <Eigen/SparseCore>

#include "cholesky/supernodes.h"

namespace snapspace {

/// The supernodes of A in the order with the fewest non-zeros: by minimum degree and, where the
/// factor is then dense enough for it to pay, by nested dissection too. Both triangles of A and its
/// diagonal are stored; only the pattern is read.
[[nodiscard]] Supernodes analysed(const Eigen::SparseMatrix<double>& A);

/// The two steps of `analysed`, for callers with an alternative for matrices with dense factors.
/// The second returns the better of the two orders.
[[nodiscard]] Supernodes by_minimum_degree(const Eigen::SparseMatrix<double>& A);
[[nodiscard]] Supernodes or_by_dissection(const Eigen::SparseMatrix<double>& A,
                                          Supernodes by_degree);

/// Whether the factor has so many entries per column that nested dissection pays.
[[nodiscard]] bool is_dense(const Supernodes& supernodes);

}  // namespace snapspace
