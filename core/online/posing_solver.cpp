#include "online/posing_solver.h"

#include "online/spd_inverse.h"

namespace snapspace::online {

PosingSolver::PosingSolver(int dimension, int handles, const double* quartic_coefficients,
                           const double* K, const double* L, const double* S)
    : elastic_(dimension, quartic_coefficients),
      handles_(dimension, handles, K, L, S),
      bfgs_(dimension),
      rest_inverse_(static_cast<std::size_t>(dimension) * dimension) {
  const std::vector<double> rest(dimension, 0.0);
  hessian(rest.data(), rest_inverse_.data());
  valid_ = invert_spd(rest_inverse_.data(), dimension);
}

}  // namespace snapspace::online
