#include "online/quartic.h"

#include <algorithm>

namespace snapspace::online {

Quartic::Quartic(int dimension, const double* coefficients)
    : dimension_(dimension),
      coefficients_(coefficients),
      x_(dimension + 1),
      pairs_(pair_count(dimension + 1)),
      pair_weights_(pair_count(dimension + 1)),
      form_gradient_(dimension + 1),
      row_(dimension + 1) {}

void Quartic::set_variables(const double* q) {
  x_[0] = 1.0;
  std::copy(q, q + dimension_, x_.begin() + 1);
  double* pair = pairs_.data();
  for (int j = 0; j <= dimension_; ++j)
    for (int i = 0; i <= j; ++i) *pair++ = x_[i] * x_[j];
}

double Quartic::value_and_gradient(const double* q, double* gradient) {
  set_variables(q);
  std::fill(pair_weights_.begin(), pair_weights_.end(), 0.0);
  std::fill(form_gradient_.begin(), form_gradient_.end(), 0.0);
  const double* c = coefficients_;
  const double* __restrict pairs = pairs_.data();
  double* __restrict weights = pair_weights_.data();
  double value = 0.0;
  for (int l = 0; l <= dimension_; ++l)
    for (int k = 0; k <= l; ++k) {
      const std::size_t count = pair_count(k + 1);
      const double outer = x_[k] * x_[l];
      // Eight partial sums let the compiler keep the dot product in vector registers.
      double sums[8] = {};
      std::size_t p = 0;
      for (; p + 8 <= count; p += 8)
        for (int s = 0; s < 8; ++s) {
          sums[s] += c[p + s] * pairs[p + s];
          weights[p + s] += outer * c[p + s];
        }
      double form =
          ((sums[0] + sums[4]) + (sums[1] + sums[5])) + ((sums[2] + sums[6]) + (sums[3] + sums[7]));
      for (; p < count; ++p) {
        form += c[p] * pairs[p];
        weights[p] += outer * c[p];
      }
      value += outer * form;
      form_gradient_[k] += x_[l] * form;
      form_gradient_[l] += x_[k] * form;
      c += count;
    }
  const double* weight = weights;
  for (int j = 0; j <= dimension_; ++j)
    for (int i = 0; i <= j; ++i, ++weight) {
      form_gradient_[i] += *weight * x_[j];
      form_gradient_[j] += *weight * x_[i];
    }
  std::copy(form_gradient_.begin() + 1, form_gradient_.end(), gradient);
  return value;
}

void Quartic::hessian(const double* q, double* hessian) {
  set_variables(q);
  const int d = dimension_;
  std::fill(hessian, hessian + static_cast<std::size_t>(d) * d, 0.0);
  std::fill(pair_weights_.begin(), pair_weights_.end(), 0.0);
  // Adds to both triangles the second derivative by x_a and x_b; x_0 is the constant 1.
  const auto add = [&](int a, int b, double value) {
    if (a == 0 || b == 0) return;
    hessian[(a - 1) * d + (b - 1)] += value;
    hessian[(b - 1) * d + (a - 1)] += value;
  };
  const double* c = coefficients_;
  for (int l = 0; l <= d; ++l)
    for (int k = 0; k <= l; ++k) {
      // With f the quadratic form of the pairs (i, j): the term is x_k x_l f(x).
      const double outer = x_[k] * x_[l];
      double twice_form = 0.0;
      std::fill(row_.begin(), row_.begin() + k + 1, 0.0);
      std::size_t p = 0;
      for (int j = 0; j <= k; ++j)
        for (int i = 0; i <= j; ++i, ++p) {
          row_[i] += c[p] * x_[j];
          row_[j] += c[p] * x_[i];
          pair_weights_[p] += outer * c[p];
        }
      for (int i = 0; i <= k; ++i) twice_form += row_[i] * x_[i];
      add(k, l, 0.5 * twice_form);
      for (int i = 0; i <= k; ++i) {
        add(k, i, x_[l] * row_[i]);
        add(l, i, x_[k] * row_[i]);
      }
      c += p;
    }
  std::size_t p = 0;
  for (int j = 0; j <= d; ++j)
    for (int i = 0; i <= j; ++i, ++p) add(i, j, pair_weights_[p]);
}

}  // namespace snapspace::online
