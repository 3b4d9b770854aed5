#include "cholesky/scalar_factor.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "cholesky/analysis.h"
#include "cholesky/column_block.h"
#include "cholesky/multifrontal.h"

namespace snapspace {

int column_block() { return kColumnBlock; }

ScalarFactor::ScalarFactor(const Eigen::SparseMatrix<double>& A) : ScalarFactor(A, analysed(A)) {}

ScalarFactor::ScalarFactor(const Eigen::SparseMatrix<double>& A, const Supernodes& supernodes)
    : size_(static_cast<std::size_t>(A.rows())) {
  values_.reserve(static_cast<std::size_t>(supernodes.entries()));
  const bool positive =
      multifrontal_cholesky(A, supernodes, [&](std::int32_t s, const auto& panel) {
        for (std::int32_t j = 0; j < supernodes.columns(s); ++j)
          vertices_.push_back(supernodes.order[supernodes.first_column[s] + j]);
        for (const std::int32_t row : supernodes.below(s))
          vertices_.push_back(supernodes.order[row]);
        add_panel(panel);
      });
  if (!positive)
    throw std::invalid_argument("ScalarFactor: the matrix of size " + std::to_string(A.rows()) +
                                " is not positive definite; every connected component needs a "
                                "handle, and the stiffness and the Lame parameters must be "
                                "positive");
  single_values_.assign(values_.begin(), values_.end());
}

/// Adds the blocks of the supernode whose vertices were added last.
void ScalarFactor::add_panel(const Eigen::MatrixXd& panel) {
  const auto height = static_cast<std::int32_t>(panel.rows());
  const auto columns = static_cast<std::int32_t>(panel.cols());
  const auto vertices = static_cast<std::int64_t>(vertices_.size()) - height;
  for (std::int32_t begin = 0; begin < columns; begin += kColumnBlock) {
    const std::int32_t end = std::min(begin + kColumnBlock, columns);
    blocks_.push_back(
        {static_cast<std::int64_t>(values_.size()), vertices + begin, end - begin, height - end});
    double inverse[kColumnBlock];
    for (std::int32_t j = begin; j < end; ++j) {
      inverse[j - begin] = 1.0 / panel(j, j);
      values_.push_back(inverse[j - begin] * inverse[j - begin]);
    }
    for (std::int32_t i = begin + 1; i < height; ++i)
      for (std::int32_t j = begin; j < std::min(i, end); ++j)
        values_.push_back(panel(i, j) * inverse[j - begin]);
  }
}

}  // namespace snapspace
