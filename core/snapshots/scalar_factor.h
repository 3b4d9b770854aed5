#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "simd/lanes.h"

namespace snapspace {

/// Cholesky factor of a scalar n x n matrix, applied to x, y, z (and to all lanes) at once.
///
/// A 3n x 3n system A (x) I is solved with the factor of A: a ninth of the work of a full
/// elasticity factor, and with one sample per lane the factor is read once for all lanes.
class ScalarFactor {
 public:
  /// @param A  symmetric positive definite, both triangles stored
  /// @throws std::invalid_argument if A is not positive definite
  explicit ScalarFactor(const Eigen::SparseMatrix<double>& A);

  [[nodiscard]] std::size_t nonzeros() const { return values_.size() + inverse_diagonal_.size(); }

  /// solution = (A (x) I3)^{-1} right_hand_side, both 3n; they may be the same. `scratch` is 3n.
  template <class Real>
  void solve(const Real* right_hand_side, Real* solution, Real* scratch) const;

 private:
  template <class T>
  struct ScalarOf {
    using type = T;
  };
  template <class T, int Width>
  struct ScalarOf<Pack<T, Width>> {
    using type = T;
  };
  template <class Real>
  using Scalar = typename ScalarOf<Real>::type;

  template <class Real>
  const Scalar<Real>* entries() const {
    if constexpr (std::is_same_v<Scalar<Real>, float>)
      return single_values_.data();
    else
      return values_.data();
  }

  std::vector<std::int32_t> order_;  // row of the factor -> vertex
  // The columns below the diagonal; column j is [column_start_[j], column_start_[j + 1]).
  std::vector<std::int64_t> column_start_;
  std::vector<std::int32_t> rows_;
  std::vector<double> values_;
  std::vector<float> single_values_;  // the same, for right-hand sides in single precision
  std::vector<double> inverse_diagonal_;
};

template <class Real>
void ScalarFactor::solve(const Real* right_hand_side, Real* solution, Real* scratch) const {
  const auto* values = entries<Real>();
  const std::int32_t n = static_cast<std::int32_t>(order_.size());
  for (std::int32_t j = 0; j < n; ++j)
    for (int c = 0; c < 3; ++c) scratch[3 * j + c] = right_hand_side[3 * order_[j] + c];

  for (std::int32_t j = 0; j < n; ++j) {
    Real* x = scratch + 3 * j;
    const Real scale(static_cast<Scalar<Real>>(inverse_diagonal_[j]));
    const Real x0 = x[0] *= scale;
    const Real x1 = x[1] *= scale;
    const Real x2 = x[2] *= scale;
    for (std::int64_t k = column_start_[j]; k < column_start_[j + 1]; ++k) {
      Real* y = scratch + 3 * rows_[k];
      const Real l(values[k]);
      y[0] -= l * x0;
      y[1] -= l * x1;
      y[2] -= l * x2;
    }
  }
  for (std::int32_t j = n - 1; j >= 0; --j) {
    Real* x = scratch + 3 * j;
    Real x0 = x[0];
    Real x1 = x[1];
    Real x2 = x[2];
    for (std::int64_t k = column_start_[j]; k < column_start_[j + 1]; ++k) {
      const Real* y = scratch + 3 * rows_[k];
      const Real l(values[k]);
      x0 -= l * y[0];
      x1 -= l * y[1];
      x2 -= l * y[2];
    }
    const Real scale(static_cast<Scalar<Real>>(inverse_diagonal_[j]));
    x[0] = x0 * scale;
    x[1] = x1 * scale;
    x[2] = x2 * scale;
  }
  for (std::int32_t j = 0; j < n; ++j)
    for (int c = 0; c < 3; ++c) solution[3 * order_[j] + c] = scratch[3 * j + c];
}

}  // namespace snapspace
