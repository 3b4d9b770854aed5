#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "online/bfgs.h"
#include "online/minimizer.h"
#include "online/newton.h"
#include "online/objective.h"
#include "online/spd_inverse.h"

namespace snapspace::online {

/// What a solve starts from: the Hessian at tau as it is, with a multiple of the identity that
/// makes it positive definite, or nothing, since it is far from that.
enum class Start { definite, shifted, none };

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

  /// Takes the Hessian at tau from objective.derivatives in d dimensions.
  Start prepare(Objective& objective, int d) {
    d_ = d;
    objective.derivatives(origin_.data(), gradient_.data(), hessian_.data());
    double largest = 0.0;
    for (int i = 0; i < d; ++i) largest = std::max(largest, std::abs(hessian_[diagonal(i)]));
    Start start = Start::definite;
    for (double shift = kFirstShift * largest; !inverted(); shift *= kShiftFactor) {
      if (!(shift > 0.0 && shift < kLargestShift * largest)) return Start::none;
      for (int i = 0; i < d; ++i) hessian_[diagonal(i)] += shift;
      start = Start::shifted;
    }
    keep(inverse_);
    return start;
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
  // Of the largest entry of the diagonal. A saddle's negative eigenvalues are far smaller.
  static constexpr double kFirstShift = 1e-8, kShiftFactor = 4.0, kLargestShift = 0.1;

  [[nodiscard]] std::size_t diagonal(int i) const {
    return static_cast<std::size_t>(i) * (static_cast<std::size_t>(d_) + 1);
  }

  /// Sets inverse_ to that of hessian_. False if this is not positive definite.
  bool inverted() {
    std::copy_n(hessian_.data(), static_cast<std::size_t>(d_) * d_, inverse_.data());
    return invert_spd(inverse_.data(), d_, scratch_.data());
  }

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
