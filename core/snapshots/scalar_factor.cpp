#include "snapshots/scalar_factor.h"

#include <Eigen/OrderingMethods>
#include <algorithm>

#include "cholesky/multifrontal.h"

namespace snapspace {

namespace {

std::vector<std::int32_t> minimum_degree(const Eigen::SparseMatrix<double>& A) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, std::int32_t> order;
  Eigen::AMDOrdering<std::int32_t>()(A.selfadjointView<Eigen::Lower>(), order);
  return {order.indices().begin(), order.indices().end()};
}

}  // namespace

ScalarFactor::ScalarFactor(const Eigen::SparseMatrix<double>& A)
    : ScalarFactor(A, Supernodes(A, minimum_degree(A))) {}

ScalarFactor::ScalarFactor(const Eigen::SparseMatrix<double>& A, const Supernodes& supernodes)
    : size_(static_cast<std::int32_t>(A.rows())) {
  multifrontal_cholesky(A, supernodes, [&](std::int32_t s, const auto& panel) {
    const auto list = static_cast<std::int64_t>(vertices_.size());
    const std::int32_t columns = supernodes.columns(s);
    const auto height = static_cast<std::int32_t>(panel.rows());
    for (std::int32_t j = supernodes.first_column[s]; j < supernodes.first_column[s + 1]; ++j)
      vertices_.push_back(supernodes.order[j]);
    for (std::int64_t i = supernodes.first_row[s]; i < supernodes.first_row[s + 1]; ++i)
      vertices_.push_back(supernodes.order[supernodes.rows[i]]);
    for (std::int32_t begin = 0; begin < columns; begin += kBlock) {
      const std::int32_t end = std::min(begin + kBlock, columns);
      blocks_.push_back(
          {static_cast<std::int64_t>(values_.size()), list + begin, end - begin, height - end});
      for (std::int32_t j = begin; j < end; ++j)
        values_.push_back(1.0 / (panel(j, j) * panel(j, j)));
      for (std::int32_t i = begin; i < height; ++i)
        for (std::int32_t j = begin; j < std::min(i, end); ++j)
          values_.push_back(panel(i, j) / panel(j, j));
    }
  });
  single_values_.assign(values_.begin(), values_.end());
}

}  // namespace snapspace
