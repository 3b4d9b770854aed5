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
#include "simd/vectors.h"

namespace snapspace::online {

/// The matrix that a solve starts from: the Hessian at tau, the Hessian plus a multiple of the
/// identity that makes it positive definite, or none, if it is far from positive definite.
enum class Start { definite, shifted, none };

/// The minimisers of a live solve, with the objective's Hessian at tau, which is q = 0. The
/// constructor allocates all memory.
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

  /// Computes the Hessian at tau by objective.derivatives in d dimensions.
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
    forget();
    return start;
  }

  /// Minimises from q (d), in place, by Newton's method, shifted along the Hessian at tau, or by
  /// BFGS with its inverse as the first approximation (paper, sec. 6.2).
  Report minimize(Objective& objective, Method method, double* q, const Termination& stop) {
    if (method == Method::newton) return newton_.minimize(objective, d_, q, hessian_.data(), stop);
    forget();
    return bfgs_.minimize(objective, d_, q, inverse_.data(), stop);
  }

  /// Largest eigenvalue of the prepared inverse, by power iteration; two work arrays of d numbers.
  [[nodiscard]] double largest_of_inverse(double* vector, double* product) const {
    // All coordinates differ, so that no eigenvector of a symmetric model is missed.
    for (int i = 0; i < d_; ++i) vector[i] = 1.0 / (1.0 + i);
    double largest = 0.0;
    for (int iteration = 0; iteration < kPowerIterations; ++iteration) {
      const double length = std::sqrt(dot(vector, vector, d_));
      for (int i = 0; i < d_; ++i) vector[i] /= length;
      for (int i = 0; i < d_; ++i)
        product[i] = dot(inverse_.data() + static_cast<std::size_t>(i) * d_, vector, d_);
      largest = dot(product, vector, d_);
      std::copy_n(product, d_, vector);
    }
    return largest;
  }

  /// The smallest positive entry of the Hessian's diagonal, or 1 if there is none.
  [[nodiscard]] double softest_coordinate() const {
    double softest = 0.0;
    for (int i = 0; i < d_; ++i) {
      const double entry = hessian_[diagonal(i)];
      if (entry > 0.0 && (softest == 0.0 || entry < softest)) softest = entry;
    }
    return softest > 0.0 ? softest : 1.0;
  }

  /// The next BFGS starts from the inverse at tau again.
  void forget() { bfgs_.start_from(d_, inverse_.data()); }

  /// BFGS from q (d), in place, continued with the approximation of the last frame if that
  /// converged. If its line search fails, it starts from the inverse at tau.
  Report continue_bfgs(Objective& objective, double* q, const Termination& stop) {
    const Report report = bfgs_.minimize(objective, d_, q, inverse_.data(), stop);
    if (report.status != Status::converged) forget();
    return report;
  }

 private:
  // Shares of the largest diagonal entry. A saddle's negative eigenvalues are far smaller.
  static constexpr int kPowerIterations = 60;
  static constexpr double kFirstShift = 1e-8, kShiftFactor = 4.0, kLargestShift = 0.1;

  [[nodiscard]] std::size_t diagonal(int i) const {
    return static_cast<std::size_t>(i) * (static_cast<std::size_t>(d_) + 1);
  }

  /// Sets inverse_ to the inverse of hessian_. Returns false if that is not positive definite.
  bool inverted() {
    std::copy_n(hessian_.data(), static_cast<std::size_t>(d_) * d_, inverse_.data());
    return invert_spd(inverse_.data(), d_, scratch_.data());
  }

  int d_ = 0;
  Newton newton_;
  Bfgs bfgs_;
  std::vector<double> hessian_, inverse_, scratch_;
  std::vector<double> origin_, gradient_;
};

}  // namespace snapspace::online
