#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "online/bfgs.h"
#include "online/minimizer.h"
#include "online/newton.h"
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
        scratch_(hessian_.size()),
        origin_(capacity),
        gradient_(capacity) {}

  /// Takes the Hessian at tau from objective.derivatives in d dimensions. False if it is not
  /// positive definite: there is then nothing to start from.
  template <class Objective>
  bool prepare(Objective& objective, int d) {
    d_ = d;
    objective.derivatives(origin_.data(), gradient_.data(), hessian_.data());
    std::copy_n(hessian_.data(), static_cast<std::size_t>(d) * d, inverse_.data());
    return invert_spd(inverse_.data(), d, scratch_.data());
  }

  /// From q (d), in place: Newton, shifted along the Hessian at tau, or BFGS with its inverse as
  /// the first approximation (paper, sec. 6.2).
  template <class Objective>
  Report minimize(Objective& objective, Method method, double* q, const Termination& stop) {
    if (method == Method::newton) return newton_.minimize(objective, d_, q, hessian_.data(), stop);
    return bfgs_.minimize(objective, d_, q, inverse_.data(), stop);
  }

 private:
  int d_ = 0;
  Newton newton_;
  Bfgs bfgs_;
  std::vector<double> hessian_, inverse_, scratch_;
  std::vector<double> origin_, gradient_;
};

}  // namespace snapspace::online
