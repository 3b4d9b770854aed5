#pragma once
#include <vector>

#include "online/minimizers.h"
#include "online/quartic.h"

namespace snapspace::online {

/// Minimises the reduced interpolation energy sum_k w_k E_k(q), one quartic per pose, frame by
/// frame.
///
/// The coefficients are combined once per change of the weights; from then on a single quartic is
/// evaluated, whatever the number of poses. Takes no memory after construction.
class BlendingSolver {
 public:
  /// Keeps a pointer to the coefficients, poses x quartic_count(dimension + 1). The weights are
  /// equal at first.
  BlendingSolver(int dimension, int poses, const double* coefficients,
                 Storage storage = Storage::double_precision)
      : poses_(poses),
        coefficients_(coefficients),
        weights_(poses, 1.0 / poses),
        equal_(weights_),
        blended_(dimension, storage),
        minimizers_(dimension) {
    set_weights(equal_.data());
    valid_ = minimizers_.prepare(*this, dimension);
  }

  /// False if the Hessian at the mean shape, q = 0 at equal weights, is not positive definite: a
  /// solve has then no matrix to start from.
  [[nodiscard]] bool valid() const { return valid_; }

  [[nodiscard]] int poses() const { return poses_; }
  [[nodiscard]] int dimension() const { return blended_.dimension(); }
  [[nodiscard]] int capacity() const { return blended_.capacity(); }

  /// Restricts the problem to the first coordinates, 1 <= dimension <= capacity; weights stay.
  void set_dimension(int dimension) {
    blended_.set_dimension(dimension);
    blended_.combine(poses_, equal_.data(), coefficients_);
    minimizers_.prepare(*this, dimension);
    blended_.combine(poses_, weights_.data(), coefficients_);
  }

  /// Combines the coefficients for weights (poses).
  void set_weights(const double* weights) {
    weights_.assign(weights, weights + poses_);
    blended_.combine(poses_, weights, coefficients_);
  }

  double value_and_gradient(const double* q, double* gradient) {
    return blended_.value_and_gradient(q, gradient);
  }

  /// The lower triangle of the Hessian, too.
  double derivatives(const double* q, double* gradient, double* hessian) {
    return blended_.derivatives(q, gradient, hessian);
  }

  /// From q, in place.
  Report solve(double* q, Method method, const Termination& stop) {
    return minimizers_.minimize(*this, method, q, stop);
  }

 private:
  int poses_;
  const double* coefficients_;
  std::vector<double> weights_, equal_;
  Quartic blended_;
  Minimizers minimizers_;
  bool valid_ = false;
};

}  // namespace snapspace::online
