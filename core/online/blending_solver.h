#pragma once
#include <cstddef>
#include <vector>

#include "online/bfgs.h"
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
  BlendingSolver(int dimension, int poses, const double* coefficients);
  BlendingSolver(BlendingSolver&&) = default;
  BlendingSolver(const BlendingSolver&) = delete;  // blended_ would read the other's coefficients

  /// False if the Hessian at the mean shape, q = 0 at equal weights, is not positive definite: BFGS
  /// then has no matrix to start from.
  [[nodiscard]] bool valid() const { return valid_; }

  [[nodiscard]] int poses() const { return poses_; }

  /// Combines the coefficients for weights (poses).
  void set_weights(const double* weights);

  double value_and_gradient(const double* q, double* gradient) {
    return blended_.value_and_gradient(q, gradient);
  }

  void hessian(const double* q, double* hessian) { blended_.hessian(q, hessian); }

  /// BFGS from q, in place, with the inverse Hessian at the mean shape as first approximation
  /// (paper, sec. 6.2).
  Report solve(double* q, const Termination& stop) {
    return bfgs_.minimize(*this, q, mean_inverse_.data(), stop);
  }

 private:
  int poses_;
  const double* coefficients_;
  std::vector<double> combined_;
  Quartic blended_;  // reads combined_
  Bfgs bfgs_;
  std::vector<double> mean_inverse_;
  bool valid_;
};

}  // namespace snapspace::online
