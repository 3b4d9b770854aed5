#pragma once

namespace snapspace::online {

/// What is minimised: a function of reduced coordinates q (d). The calls through it take nothing
/// beside an evaluation, and the minimisers are compiled once for all solvers.
class Objective {
 public:
  /// Value at q; `gradient` (d) is overwritten.
  virtual double value_and_gradient(const double* q, double* gradient) = 0;
  /// The lower triangle of the Hessian (d x d), too.
  virtual double derivatives(const double* q, double* gradient, double* hessian) = 0;

 protected:
  Objective() = default;
  Objective(const Objective&) = default;
  Objective(Objective&&) = default;
  Objective& operator=(const Objective&) = default;
  Objective& operator=(Objective&&) = default;
  ~Objective() = default;
};

}  // namespace snapspace::online
