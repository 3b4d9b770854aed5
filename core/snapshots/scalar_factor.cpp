#include "snapshots/scalar_factor.h"

#include <Eigen/SparseCholesky>
#include <stdexcept>
#include <string>

namespace snapspace {

ScalarFactor::ScalarFactor(const Eigen::SparseMatrix<double>& A) {
  const Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>>
      llt(A);
  if (llt.info() != Eigen::Success)
    throw std::invalid_argument("ScalarFactor: the matrix of size " + std::to_string(A.rows()) +
                                " is not positive definite; every connected component needs a "
                                "handle, and the stiffness and the Lame parameters must be "
                                "positive");
  const Eigen::SparseMatrix<double>& L = llt.matrixL().nestedExpression();
  const Eigen::Index n = L.rows();
  order_.resize(n);
  for (Eigen::Index v = 0; v < n; ++v)
    order_[llt.permutationP().indices()[v]] = static_cast<int>(v);

  column_start_.reserve(n + 1);
  column_start_.push_back(0);
  inverse_diagonal_.reserve(n);
  rows_.reserve(L.nonZeros() - n);
  values_.reserve(L.nonZeros() - n);
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(L, j); entry; ++entry) {
      if (entry.row() == j) {
        inverse_diagonal_.push_back(1.0 / entry.value());
      } else {
        rows_.push_back(static_cast<std::int32_t>(entry.row()));
        values_.push_back(entry.value());
      }
    }
    column_start_.push_back(static_cast<std::int64_t>(rows_.size()));
  }
  single_values_.assign(values_.begin(), values_.end());
}

}  // namespace snapspace
