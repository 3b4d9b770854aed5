#pragma once
#include "online/half_runner.h"

namespace snapspace::online {

/// The function of reduced coordinates q (d) that is minimised. The cost of virtual calls is
/// negligible beside an evaluation, and the minimisers are compiled once for all solvers.
class Objective {
 public:
  /// Value at q; `gradient` (d) is overwritten.
  virtual double value_and_gradient(const double* q, double* gradient) = 0;
  /// Also writes the lower triangle of the Hessian (d x d).
  virtual double derivatives(const double* q, double* gradient, double* hessian) = 0;
  /// Runs halves of large evaluations and of what minimisers add to them; may be null.
  [[nodiscard]] virtual HalfRunner* half_runner() const { return nullptr; }

 protected:
  Objective() = default;
  Objective(const Objective&) = default;
  Objective(Objective&&) = default;
  Objective& operator=(const Objective&) = default;
  Objective& operator=(Objective&&) = default;
  ~Objective() = default;
};

}  // namespace snapspace::online
