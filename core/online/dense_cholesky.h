#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "simd/vectors.h"

namespace snapspace::online {

/// Cholesky factor of dense symmetric matrices up to a given size. The constructor allocates all
/// memory.
class DenseCholesky {
 public:
  explicit DenseCholesky(int capacity)
      : factor_(static_cast<std::size_t>(capacity) * capacity), column_(capacity) {}

  /// Factors a matrix (d x d, row-major, lower triangle read). Returns -1, or the first row whose
  /// leading block is not positive definite.
  int factor(const double* matrix, int d) {
    d_ = d;
    for (int i = 0; i < d; ++i)
      for (int j = 0; j <= i; ++j) row(i)[j] = matrix[static_cast<std::size_t>(i) * d + j];
    for (int k = 0; k < d; ++k) {
      if (!(row(k)[k] > 0.0)) return k;
      const double pivot = std::sqrt(row(k)[k]);
      row(k)[k] = pivot;
      for (int i = k + 1; i < d; ++i) column_[i] = row(i)[k] /= pivot;
      for (int i = k + 1; i < d; ++i)  // along rows, which are contiguous
        add_scaled(-column_[i], &column_[k + 1], row(i) + k + 1, i - k);
    }
    return -1;
  }

  /// x = matrix^-1 b; x and b may be the same array.
  void solve(const double* b, double* x) const {
    for (int i = 0; i < d_; ++i) x[i] = (b[i] - dot(row(i), x, i)) / row(i)[i];
    solve_transposed(d_, x);
  }

  /// After factor() returned `failed`: a direction v (d), v_failed = 1, along which the matrix is
  /// not positive, v.Av <= 0 (Conn, Gould & Toint 2000, sec. 5.4).
  void negative_direction(int failed, double* v) const {
    for (int i = 0; i < d_; ++i) v[i] = 0.0;
    for (int i = 0; i < failed; ++i) v[i] = -row(failed)[i];
    solve_transposed(failed, v);
    v[failed] = 1.0;
  }

 private:
  double* row(int i) { return factor_.data() + static_cast<std::size_t>(i) * d_; }
  [[nodiscard]] const double* row(int i) const {
    return factor_.data() + static_cast<std::size_t>(i) * d_;
  }

  /// x = L^-T x for the first n rows.
  void solve_transposed(int n, double* x) const {
    for (int i = n - 1; i >= 0; --i) {
      x[i] /= row(i)[i];
      add_scaled(-x[i], row(i), x, i);
    }
  }

  int d_ = 0;
  std::vector<double> factor_, column_;
};

}  // namespace snapspace::online
