#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "online/minimizer.h"
#include "online/objective.h"
#include "simd/vectors.h"

namespace snapspace::online {

/// BFGS on the inverse Hessian (Nocedal & Wright 2006, alg. 6.1) with a line search for the weak
/// Wolfe conditions, which keep the inverse positive definite. The constructor allocates all
/// memory.
class Bfgs {
 public:
  explicit Bfgs(int capacity)
      : inverse_(static_cast<std::size_t>(capacity) * capacity),
        gradient_(capacity),
        direction_(capacity),
        trial_(capacity),
        trial_gradient_(capacity),
        change_(capacity),
        product_(capacity) {}

  /// Minimises objective.value_and_gradient(q, g) over q (d), in place. The value at q never gets
  /// worse or non-finite.
  /// @param initial_inverse  d x d, symmetric positive definite
  Report minimize(Objective& objective, int d, double* q, const double* initial_inverse,
                  const Termination& stop);

  /// The approximation at the end of the last minimisation, d x d.
  [[nodiscard]] const std::vector<double>& inverse() const { return inverse_; }

 private:
  static constexpr int kMaxTrials = 40;
  static constexpr int kMaxIdleSteps = 4;

  bool line_search(Objective& objective, const double* q, Report& report, double slope,
                   const Termination& stop);
  double evaluate(Objective& objective, const double* q, double step, Report& report);
  void set_direction();
  void update();

  int d_ = 0;
  std::vector<double> inverse_, gradient_, direction_, trial_, trial_gradient_, change_, product_;
  double step_ = 1.0;
  double trial_value_ = 0.0;
};

inline Report Bfgs::minimize(Objective& objective, int d, double* q, const double* initial_inverse,
                             const Termination& stop) {
  d_ = d;
  Report report{Status::max_iterations, 0, 1, 0.0, 0.0};
  report.value = objective.value_and_gradient(q, gradient_.data());
  report.gradient_norm = std::sqrt(dot(gradient_.data(), gradient_.data(), d_));
  if (!std::isfinite(report.value) || !std::isfinite(report.gradient_norm)) {
    report.status = Status::not_finite;
    return report;
  }
  const auto reset = [&] {
    std::copy(initial_inverse, initial_inverse + static_cast<std::size_t>(d_) * d_,
              inverse_.begin());
  };
  reset();
  bool pristine = true;
  int idle_steps = 0;  // consecutive accepted steps that did not change the value
  while (report.iterations < stop.max_iterations) {
    set_direction();
    const double slope = dot(gradient_.data(), direction_.data(), d_);
    if (slope == 0.0) {
      report.status = Status::converged;
      break;
    }
    if (!(slope < 0.0) || !line_search(objective, q, report, slope, stop)) {
      if (report.evaluations >= stop.max_evaluations) {
        report.status = Status::max_evaluations;
        break;
      }
      // Either the approximation is bad, which a restart cures once, or values no longer resolve a
      // decrease.
      if (pristine) {
        report.status = terminates(stop, report, 0.0, 0.0, std::sqrt(dot(q, q, d_)))
                            ? Status::converged
                            : Status::line_search_failed;
        break;
      }
      reset();
      pristine = true;
      continue;
    }
    ++report.iterations;
    const double decrease = report.value - trial_value_;
    report.value = trial_value_;
    idle_steps = decrease > 0.0 ? 0 : idle_steps + 1;
    update();
    pristine = false;
    std::copy_n(trial_.begin(), d_, q);
    gradient_.swap(trial_gradient_);
    report.gradient_norm = std::sqrt(dot(gradient_.data(), gradient_.data(), d_));
    const double step = step_ * std::sqrt(dot(direction_.data(), direction_.data(), d_));
    if (terminates(stop, report, decrease, step, std::sqrt(dot(q, q, d_)))) {
      report.status = Status::converged;
      break;
    }
    if (idle_steps == kMaxIdleSteps) {  // the tolerance is below the resolution of values
      report.status = Status::line_search_failed;
      break;
    }
  }
  return report;
}

inline double Bfgs::evaluate(Objective& objective, const double* q, double step, Report& report) {
  for (int i = 0; i < d_; ++i) trial_[i] = q[i] + step * direction_[i];
  trial_value_ = objective.value_and_gradient(trial_.data(), trial_gradient_.data());
  ++report.evaluations;
  return dot(trial_gradient_.data(), direction_.data(), d_);
}

/// Bisection with expansion between a point that is too near (still steep) and one that is too far
/// (too high). On success trial_ holds the accepted point.
inline bool Bfgs::line_search(Objective& objective, const double* q, Report& report, double slope,
                              const Termination& stop) {
  constexpr double kDecrease = 1e-4;
  constexpr double kCurvature = 0.9;
  double near = 0.0;
  double far = std::numeric_limits<double>::infinity();
  step_ = 1.0;
  for (int trial = 0; trial < kMaxTrials; ++trial) {
    if (report.evaluations >= stop.max_evaluations) return false;
    const double trial_slope = evaluate(objective, q, step_, report);
    const bool finite = std::isfinite(trial_value_) && std::isfinite(trial_slope);
    if (!finite || trial_value_ > report.value + kDecrease * step_ * slope) {
      far = step_;
      // Minimiser of the parabola through the value and slope at 0 and the value here, as long as
      // no nearer point is known.
      const double parabola =
          -0.5 * slope * step_ * step_ / (trial_value_ - report.value - slope * step_);
      const bool usable = finite && near == 0.0 && parabola > 0.1 * step_ && parabola < 0.5 * step_;
      step_ = usable ? parabola : 0.5 * (near + far);
    } else if (trial_slope < kCurvature * slope) {
      near = step_;
      step_ = std::isinf(far) ? 2.0 * step_ : 0.5 * (near + far);
    } else {
      return true;
    }
  }
  if (near == 0.0) return false;
  step_ = near;  // sufficient decrease, although still steep
  evaluate(objective, q, step_, report);
  return true;
}

inline void Bfgs::set_direction() {
  for (int i = 0; i < d_; ++i)
    direction_[i] = -dot(inverse_.data() + static_cast<std::size_t>(i) * d_, gradient_.data(), d_);
}

/// H += (1 + y.Hy / s.y) s s^T / s.y - (Hy s^T + s (Hy)^T) / s.y, with s the step and y the change
/// of the gradient.
inline void Bfgs::update() {
  for (int i = 0; i < d_; ++i) change_[i] = trial_gradient_[i] - gradient_[i];
  const double sy = step_ * dot(direction_.data(), change_.data(), d_);
  const double yy = dot(change_.data(), change_.data(), d_);
  const double ss = step_ * step_ * dot(direction_.data(), direction_.data(), d_);
  // Without enough curvature (possible only if the search ended early) the old inverse is kept.
  if (!(sy > 1e-14 * std::sqrt(ss * yy))) return;
  for (int i = 0; i < d_; ++i)
    product_[i] = dot(inverse_.data() + static_cast<std::size_t>(i) * d_, change_.data(), d_);
  const double rho = 1.0 / sy;
  const double ss_weight = rho * (1.0 + rho * dot(change_.data(), product_.data(), d_));
  for (int i = 0; i < d_; ++i) {
    double* row = inverse_.data() + static_cast<std::size_t>(i) * d_;
    const double s_i = step_ * direction_[i];
    const double a = ss_weight * s_i - rho * product_[i];
    for (int j = 0; j < d_; ++j) row[j] += a * step_ * direction_[j] - rho * s_i * product_[j];
  }
}

}  // namespace snapspace::online
