#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace snapspace {

/// An order of elimination in which a Cholesky factor of A has few non-zeros: vertex by vertex.
[[nodiscard]] std::vector<std::int32_t> elimination_order(const Eigen::SparseMatrix<double>& A);

/// The same by nested dissection whatever the size
[[nodiscard]] std::vector<std::int32_t> nested_dissection(const Eigen::SparseMatrix<double>& A);
[[nodiscard]] std::vector<std::int32_t> minimum_degree(const Eigen::SparseMatrix<double>& A);

}  // namespace snapspace
