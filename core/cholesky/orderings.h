#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace snapspace {

/// Elimination orders in which the Cholesky factor of A has few non-zeros, as lists of vertices.
/// Both triangles of A and its diagonal are stored; only the pattern is read.
/// Approximate minimum degree is quick, and as good as any where bodies are thin. Nested dissection
/// takes ten to twenty times as long, and leaves a third fewer non-zeros in solid bodies.
[[nodiscard]] std::vector<std::int32_t> minimum_degree(const Eigen::SparseMatrix<double>& A);
[[nodiscard]] std::vector<std::int32_t> nested_dissection(const Eigen::SparseMatrix<double>& A);

}  // namespace snapspace
