#include "cholesky/analysis.h"

#include <utility>

#include "cholesky/orderings.h"

namespace snapspace {

bool is_dense(const Supernodes& supernodes) {
  // Entries per column: 50 to 70 in the paper's meshes, which are thin, so that dissection saves
  // less than its own time; 130 in a solid body of 75k tets, where it saves a seventh; 270 in one
  // of 250k, where it saves a third; and 680 in one of 1M, where it saves half.
  constexpr std::size_t kDense = 140;
  return static_cast<std::size_t>(supernodes.entries()) > kDense * supernodes.order.size();
}

Supernodes by_minimum_degree(const Eigen::SparseMatrix<double>& A) {
  return {A, minimum_degree(A)};
}

Supernodes or_by_dissection(const Eigen::SparseMatrix<double>& A, Supernodes by_degree) {
  Supernodes by_dissection(A, nested_dissection(A));
  return by_dissection.entries() < by_degree.entries() ? by_dissection : std::move(by_degree);
}

Supernodes analysed(const Eigen::SparseMatrix<double>& A) {
  Supernodes by_degree = by_minimum_degree(A);
  return is_dense(by_degree) ? or_by_dissection(A, std::move(by_degree)) : by_degree;
}

}  // namespace snapspace
