#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "online/bfgs.h"
#include "online/minimizer.h"
#include "online/newton.h"
#include "online/objective.h"
#include "online/spd_inverse.h"

namespace snapspace::online {

/// The minimisers of a live solve, and what they know of the objective from the start: its Hessian
/// at tau, which is q = 0. All memory is taken in the constructor.
class Minimizers {
 public:
  explicit Minimizers(int capacity)
      : newton_(capacity),
        bfgs_(capacity),
        hessian_(static_cast<std::size_t>(capacity) * capacity),
        inverse_(hessian_.size()),
        last_(hessian_.size()),
        scratch_(hessian_.size()),
        origin_(capacity),
        gradient_(capacity) {}

  /// Takes the Hessian at tau from objective.derivatives in d dimensions. False if it is not
  /// positive definite: there is then nothing to start from.
  bool prepare(Objective& objective, int d) {
    d_ = d;
    objective.derivatives(origin_.data(), gradient_.data(), hessian_.data());
    std::copy_n(hessian_.data(), static_cast<std::size_t>(d) * d, inverse_.data());
    const bool definite = invert_spd(inverse_.data(), d, scratch_.data());
    keep(inverse_);
    return definite;
  }

  /// From q (d), in place: Newton, shifted along the Hessian at tau, or BFGS with its inverse as
  /// the first approximation (paper, sec. 6.2).
  Report minimize(Objective& objective, Method method, double* q, const Termination& stop) {
    if (method == Method::newton) return newton_.minimize(objective, d_, q, hessian_.data(), stop);
    return bfgs_.minimize(objective, d_, q, inverse_.data(), stop);
  }

  /// BFGS from q (d), in place, that goes on with the approximation of the last frame, if that
  /// converged. Where it leads nowhere, once more from the inverse at tau; the report counts both.
  Report minimize_onwards(Objective& objective, double* q, const Termination& stop) {
    Report report = bfgs_.minimize(objective, d_, q, last_.data(), stop);
    if (report.status == Status::line_search_failed) {
      Termination rest = stop;
      rest.max_iterations -= report.iterations;
      rest.max_evaluations -= report.evaluations;
      const Report again = bfgs_.minimize(objective, d_, q, inverse_.data(), rest);
      report = {again.status, report.iterations + again.iterations,
                report.evaluations + again.evaluations, again.value, again.gradient_norm};
    }
    keep(report.status == Status::converged ? bfgs_.inverse() : inverse_);
    return report;
  }

 private:
  void keep(const std::vector<double>& inverse) {
    std::copy_n(inverse.data(), static_cast<std::size_t>(d_) * d_, last_.data());
  }

  int d_ = 0;
  Newton newton_;
  Bfgs bfgs_;
  std::vector<double> hessian_, inverse_, last_, scratch_;
  std::vector<double> origin_, gradient_;
};

}  // namespace snapspace::online
