#pragma once
#include <vector>

#include "online/bfgs.h"
#include "online/handle_quadric.h"
#include "online/quartic.h"

namespace snapspace::online {

/// Minimises the reduced posing energy, elastic quartic + handle quadric, frame by frame.
///
/// This is the live loop. Its cost depends on the dimension and the number of handles only, and it
/// takes no memory after construction.
class PosingSolver {
 public:
  /// Keeps pointers to the arrays, which are as Quartic and HandleQuadric take them.
  PosingSolver(int dimension, int handles, const double* quartic_coefficients, const double* K,
               const double* L, const double* S);

  /// False if the Hessian at rest is not positive definite: BFGS then has no matrix to start from.
  [[nodiscard]] bool valid() const { return valid_; }

  [[nodiscard]] int handles() const { return handles_.handles(); }

  void set_offsets(const double* offsets) { handles_.set_offsets(offsets); }

  double value_and_gradient(const double* q, double* gradient) {
    const double elastic = elastic_.value_and_gradient(q, gradient);
    return elastic + handles_.add_value_and_gradient(q, gradient);
  }

  void hessian(const double* q, double* hessian) {
    elastic_.hessian(q, hessian);
    handles_.add_hessian(hessian);
  }

  /// BFGS from q, in place, with the inverse Hessian at rest as first approximation (sec. 6.2).
  Report solve(double* q, const Termination& stop) {
    return bfgs_.minimize(*this, q, rest_inverse_.data(), stop);
  }

 private:
  Quartic elastic_;
  HandleQuadric handles_;
  Bfgs bfgs_;
  std::vector<double> rest_inverse_;
  bool valid_;
};

}  // namespace snapspace::online
