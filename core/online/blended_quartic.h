#pragma once
#include <vector>

#include "online/quartic.h"

namespace snapspace::online {

/// The blended energy sum_k w_k E_k of several poses, one quartic per pose. The coefficients are
/// combined once per change of the weights; then a single quartic is evaluated, for any number of
/// poses. Allocates no memory after construction.
class BlendedQuartic {
 public:
  static constexpr bool kHessianIsExpensive = Quartic::kHessianIsExpensive;
  [[nodiscard]] static HalfRunner* half_runner() { return Quartic::half_runner(); }

  /// Keeps a pointer to the coefficients, poses x quartic_count(dimension + 1). The weights are
  /// initially zero.
  BlendedQuartic(int dimension, int poses, const double* coefficients,
                 Storage storage = Storage::double_precision)
      : poses_(poses), coefficients_(coefficients), sum_(dimension, storage) {}

  [[nodiscard]] int poses() const { return poses_; }
  [[nodiscard]] int dimension() const { return sum_.dimension(); }
  [[nodiscard]] int capacity() const { return sum_.capacity(); }

  /// Restricts the energy to the first coordinates, 1 <= dimension <= capacity.
  void set_dimension(int dimension) { sum_.set_dimension(dimension); }
  /// Sets the weights of the poses.
  void set_weights(const double* weights) { sum_.combine(poses_, weights, coefficients_); }

  double value_and_gradient(const double* q, double* gradient) {
    return sum_.value_and_gradient(q, gradient);
  }
  double derivatives(const double* q, double* gradient, double* hessian) {
    return sum_.derivatives(q, gradient, hessian);
  }

 private:
  int poses_;
  const double* coefficients_;
  Quartic sum_;
};

}  // namespace snapspace::online
