#pragma once
#include <cstddef>
#include <vector>

namespace snapspace::online {

/// Number of monomials q_i q_j, i <= j < n.
constexpr std::size_t pair_count(std::size_t n) { return n * (n + 1) / 2; }
/// Number of monomials of degree four in n variables, C(n + 3, 4).
constexpr std::size_t quartic_count(std::size_t n) {
  return n * (n + 1) / 2 * (n + 2) / 3 * (n + 3) / 4;
}

/// A polynomial of degree four in d variables q, as one form of degree four in x = (1, q).
///
/// Coefficients of the monomials x_i x_j x_k x_l, i <= j <= k <= l, are stored with l slowest and i
/// fastest. The polynomial restricted to the first d' < d variables is therefore a prefix of the
/// array. For fixed (k, l) the coefficients of all pairs i <= j <= k are contiguous: value and
/// gradient read the array once, front to back.
class Quartic {
 public:
  /// @param coefficients  quartic_count(dimension + 1) doubles, kept alive by the caller
  Quartic(int dimension, const double* coefficients);

  [[nodiscard]] int dimension() const { return dimension_; }

  /// Value at q (d); `gradient` (d) is overwritten.
  double value_and_gradient(const double* q, double* gradient);

  /// Hessian at q, d x d, both triangles; overwritten.
  void hessian(const double* q, double* hessian);

 private:
  void set_variables(const double* q);

  int dimension_;
  const double* coefficients_;
  std::vector<double> x_;              // (1, q)
  std::vector<double> pairs_;          // x_i x_j, j slowest
  std::vector<double> pair_weights_;   // derivative of the value by x_i x_j with x_k x_l held
  std::vector<double> form_gradient_;  // by x
  std::vector<double> row_;            // gradient of one quadratic form of (i, j)
};

}  // namespace snapspace::online
