#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "online/dense_cholesky.h"
#include "online/line_quartic.h"
#include "online/minimizer.h"
#include "online/objective.h"
#include "simd/vectors.h"

namespace snapspace::online {

/// Newton's method with a shifted Hessian and a line search. The constructor allocates all memory.
/// Where the Hessian H is not positive definite, H + shift * metric replaces it (Nocedal & Wright
/// 2006, sec. 3.4): with the Hessian at rest as the metric, a shift has no unit and acts equally on
/// stiff and soft directions. A step is first tried at full length. If that does not decrease the
/// value sufficiently, or ends where the line is still steep, the next trial is the minimiser of
/// the LineQuartic, which is exact for quartic objectives. A point where the gradient vanishes but
/// the Hessian is not positive definite is a saddle, and is left along a direction of negative
/// curvature.
class Newton {
 public:
  explicit Newton(int capacity)
      : cholesky_(capacity),
        hessian_(static_cast<std::size_t>(capacity) * capacity),
        trial_hessian_(hessian_.size()),
        shifted_(hessian_.size()),
        gradient_(capacity),
        trial_gradient_(capacity),
        direction_(capacity),
        trial_(capacity) {}

  /// Minimises objective.derivatives(q, g, H) (H: lower triangle) over q (d), in place. The value
  /// at q never gets non-finite, or worse by more than rounding.
  /// The termination tests are applied to the next step, with its predicted decrease: it need not
  /// be taken to find that it is too short.
  /// @param metric  d x d, symmetric positive definite; lower triangle read
  Report minimize(Objective& objective, int d, double* q, const double* metric,
                  const Termination& stop) {
    d_ = d;
    shift_ = 0.0;
    Report report{Status::max_iterations, 0, 1, 0.0, 0.0};
    report.value = objective.derivatives(q, gradient_.data(), hessian_.data());
    if (!accept_gradient(report)) {
      report.status = Status::not_finite;
      return report;
    }
    while (report.iterations < stop.max_iterations) {
      if (report.evaluations >= stop.max_evaluations) {
        report.status = Status::max_evaluations;
        return report;
      }
      if (!set_direction(metric)) {
        report.status = Status::line_search_failed;
        return report;
      }
      const double length = std::sqrt(dot(q, q, d_));
      double slope;
      if (is_short(report, stop, length, slope)) {
        // A shift shortens steps, so only a step without a shift is conclusive.
        if (shift_ == 0.0 || (unshifted_direction(0.1 * (stop.coordinate_scale + length)) &&
                              is_short(report, stop, length, slope))) {
          report.status = Status::converged;
          return report;
        }
        slope = dot(gradient_.data(), direction_.data(), d_);
      }
      if (!search(objective, q, report, slope, stop)) {
        shift_ *= kShiftFactor;  // a matrix that is barely definite makes a step far too long
        if (shift_ > 0.0) continue;
        report.status = report.evaluations >= stop.max_evaluations   ? Status::max_evaluations
                        : terminates(stop, report, 0.0, 0.0, length) ? Status::converged
                                                                     : Status::line_search_failed;
        return report;
      }
      ++report.iterations;
      shift_ = shift_ > kFirstShift ? shift_ / kShiftFactor : 0.0;
      report.value = trial_value_;
      std::copy_n(trial_.data(), d_, q);
      gradient_.swap(trial_gradient_);
      hessian_.swap(trial_hessian_);
      accept_gradient(report);
    }
    return report;
  }

 private:
  static constexpr int kMaxTrials = 12;
  static constexpr double kFirstShift = 1.0 / 64.0, kShiftFactor = 4.0, kLargestShift = 1e12;
  static constexpr double kSufficientDecrease = 1e-4, kSteep = 0.5, kLongestStep = 8.0;
  static constexpr double kRounding = 1e-10;

  bool accept_gradient(Report& report) const {
    report.gradient_norm = std::sqrt(dot(gradient_.data(), gradient_.data(), d_));
    return std::isfinite(report.value) && std::isfinite(report.gradient_norm);
  }

  /// direction = -(H + shift metric)^-1 gradient, with the smallest shift from the current one on
  /// that makes the matrix positive definite. Returns false if there is none, since the Hessian is
  /// not finite or no step was short enough.
  bool set_direction(const double* metric) {
    for (; shift_ < kLargestShift; shift_ = shift_ == 0.0 ? kFirstShift : kShiftFactor * shift_) {
      if (factor(metric) >= 0) continue;
      for (int i = 0; i < d_; ++i) trial_[i] = -gradient_[i];
      cholesky_.solve(trial_.data(), direction_.data());
      return true;
    }
    return false;
  }

  int factor(const double* metric) {
    if (shift_ == 0.0) return cholesky_.factor(hessian_.data(), d_);
    const std::size_t size = static_cast<std::size_t>(d_) * d_;
    for (std::size_t i = 0; i < size; ++i) shifted_[i] = hessian_[i] + shift_ * metric[i];
    return cholesky_.factor(shifted_.data(), d_);
  }

  /// Whether the step along the direction would end the iteration; sets the slope.
  bool is_short(const Report& report, const Termination& stop, double length, double& slope) const {
    slope = dot(gradient_.data(), direction_.data(), d_);
    const double step = std::sqrt(dot(direction_.data(), direction_.data(), d_));
    return slope == 0.0 || terminates(stop, report, -0.5 * slope, step, length);
  }

  /// Sets the Newton direction without a shift and returns true if the Hessian is positive
  /// definite. Otherwise sets a descent direction of negative curvature with the given length.
  bool unshifted_direction(double length) {
    shift_ = 0.0;
    const int failed = cholesky_.factor(hessian_.data(), d_);
    if (failed < 0) {
      for (int i = 0; i < d_; ++i) trial_[i] = -gradient_[i];
      cholesky_.solve(trial_.data(), direction_.data());
      return true;
    }
    cholesky_.negative_direction(failed, direction_.data());
    double factor = length / std::sqrt(dot(direction_.data(), direction_.data(), d_));
    if (dot(gradient_.data(), direction_.data(), d_) > 0.0) factor = -factor;
    for (int i = 0; i < d_; ++i) direction_[i] *= factor;
    return false;
  }

  /// Finds a trial_ with sufficient decrease. Returns false if no trial has one.
  bool search(Objective& objective, const double* q, Report& report, double slope,
              const Termination& stop) {
    double step = 1.0;
    for (int trial = 0; trial < kMaxTrials; ++trial) {
      if (report.evaluations >= stop.max_evaluations) return false;
      const double trial_slope = evaluate(objective, q, step, report);
      const bool finite = std::isfinite(trial_value_) && std::isfinite(trial_slope);
      const bool lower = finite && trial_value_ < report.value &&
                         trial_value_ <= report.value + kSufficientDecrease * step * slope;
      if (finite && is_level(report, slope, stop)) return true;
      if (trial > 0 || !finite) {
        if (lower) return true;
        step *= finite ? 0.5 : 0.1;
        continue;
      }
      if (lower && trial_slope > kSteep * slope) return true;
      const LineQuartic line(report.value, slope, curvature(), trial_value_, trial_slope);
      step = lower ? line.first_minimum(1.0, kLongestStep) : line.first_minimum(0.0, 1.0);
      if (step == 1.0) step = 0.5;
      if (lower) return extend(objective, q, report, step, stop);
    }
    return false;
  }

  /// Whether the trial has at most half the gradient where values are only rounding: close to a
  /// minimum they do not resolve the decrease along stiff directions.
  bool is_level(const Report& report, double slope, const Termination& stop) const {
    const double rounding = kRounding * (std::abs(report.value) + stop.value_scale);
    return -slope <= rounding && std::abs(trial_value_ - report.value) <= rounding &&
           dot(trial_gradient_.data(), trial_gradient_.data(), d_) <
               0.25 * report.gradient_norm * report.gradient_norm;
  }

  /// Extends an acceptable step to a longer one if that is better.
  bool extend(Objective& objective, const double* q, Report& report, double step,
              const Termination& stop) {
    if (report.evaluations + 1 >= stop.max_evaluations) return true;
    const double before = trial_value_;
    const double slope = evaluate(objective, q, step, report);
    if (trial_value_ <= before && std::isfinite(slope)) return true;
    evaluate(objective, q, 1.0, report);
    return true;
  }

  /// direction . H direction
  double curvature() const {
    double sum = 0.0;
    for (int i = 0; i < d_; ++i) {
      const double* row = hessian_.data() + static_cast<std::size_t>(i) * d_;
      sum += direction_[i] * (2.0 * dot(row, direction_.data(), i) + row[i] * direction_[i]);
    }
    return sum;
  }

  double evaluate(Objective& objective, const double* q, double step, Report& report) {
    for (int i = 0; i < d_; ++i) trial_[i] = q[i] + step * direction_[i];
    trial_value_ =
        objective.derivatives(trial_.data(), trial_gradient_.data(), trial_hessian_.data());
    ++report.evaluations;
    return dot(trial_gradient_.data(), direction_.data(), d_);
  }

  int d_ = 0;
  double shift_ = 0.0;
  double trial_value_ = 0.0;
  DenseCholesky cholesky_;
  std::vector<double> hessian_, trial_hessian_, shifted_;
  std::vector<double> gradient_, trial_gradient_, direction_, trial_;
};

}  // namespace snapspace::online
