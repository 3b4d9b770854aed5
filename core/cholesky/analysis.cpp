#include "cholesky/analysis.h"

#include "cholesky/orderings.h"

namespace snapspace {

Supernodes analysed(const Eigen::SparseMatrix<double>& A) {
  // Entries per column: 50 to 70 in the paper's meshes, which are thin, where dissection saves
  // nothing that is worth its time; 130 in a solid body of 75k tets, where it saves a seventh; 270
  // in one of 250k, where it saves a third; and 680 in one of 1M, where it saves a half.
  constexpr std::int64_t kMany = 140;
  Supernodes by_degree(A, minimum_degree(A));
  if (by_degree.entries() <= kMany * A.cols()) return by_degree;
  Supernodes by_dissection(A, nested_dissection(A));
  return by_dissection.entries() < by_degree.entries() ? by_dissection : by_degree;
}

}  // namespace snapspace
