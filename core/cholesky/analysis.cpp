#include "cholesky/analysis.h"

#include "cholesky/orderings.h"

namespace snapspace {

Supernodes analysed(const Eigen::SparseMatrix<double>& A) {
  // Entries per column: 50 to 70 in the paper's meshes, which are thin; 160 in a solid body of 100k
  // tets, where dissection saves a seventh, and 270 in one of 250k, where it saves a quarter. Up to
  // about 110 it saves nothing.
  constexpr std::int64_t kMany = 140;
  Supernodes by_degree(A, minimum_degree(A));
  if (by_degree.entries() <= kMany * A.cols()) return by_degree;
  Supernodes by_dissection(A, nested_dissection(A));
  return by_dissection.entries() < by_degree.entries() ? by_dissection : by_degree;
}

}  // namespace snapspace
