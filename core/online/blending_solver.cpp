#include "online/blending_solver.h"

#include "online/spd_inverse.h"

namespace snapspace::online {

BlendingSolver::BlendingSolver(int dimension, int poses, const double* coefficients)
    : poses_(poses),
      coefficients_(coefficients),
      combined_(quartic_count(dimension + 1)),
      blended_(dimension, combined_.data()),
      bfgs_(dimension),
      mean_inverse_(static_cast<std::size_t>(dimension) * dimension) {
  const std::vector<double> equal(poses, 1.0 / poses);
  const std::vector<double> mean(dimension, 0.0);
  set_weights(equal.data());
  hessian(mean.data(), mean_inverse_.data());
  valid_ = invert_spd(mean_inverse_.data(), dimension);
}

void BlendingSolver::set_weights(const double* weights) {
  for (double& c : combined_) c = 0.0;
  for (int k = 0; k < poses_; ++k) {
    const double* pose = coefficients_ + k * combined_.size();
    for (std::size_t i = 0; i < combined_.size(); ++i) combined_[i] += weights[k] * pose[i];
  }
}

}  // namespace snapspace::online
