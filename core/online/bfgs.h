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
/// Wolfe conditions, which keep the inverse positive definite. An iteration passes over the inverse
/// once: the update of the previous iteration is done on the way, and the next direction follows
/// from the product with the new gradient. The constructor allocates all memory.
class Bfgs {
 public:
  explicit Bfgs(int capacity)
      : inverse_(static_cast<std::size_t>(capacity) * capacity),
        gradient_(capacity),
        direction_(capacity),
        trial_(capacity),
        trial_gradient_(capacity),
        change_(capacity),
        product_(capacity),
        update_step_(capacity),
        update_product_(capacity) {}

  /// Starts the approximation from this inverse, d x d, symmetric positive definite.
  void start_from(int d, const double* inverse) {
    std::copy_n(inverse, static_cast<std::size_t>(d) * d, inverse_.begin());
    pending_ = false;
  }

  /// Minimises objective.value_and_gradient(q, g) over q (d), in place, with the present
  /// approximation, which is kept for the next minimisation. The value at q never gets worse or
  /// non-finite.
  /// @param fallback  d x d, symmetric positive definite: what the approximation starts from again
  ///                  if a line search fails
  Report minimize(Objective& objective, int d, double* q, const double* fallback,
                  const Termination& stop);

 private:
  static constexpr int kMaxTrials = 40;
  static constexpr int kMaxIdleSteps = 4;

  bool line_search(Objective& objective, const double* q, Report& report, double slope,
                   const Termination& stop);
  double evaluate(Objective& objective, const double* q, double step, Report& report);
  void multiply(const double* gradient);
  void set_direction();
  void advance();

  int d_ = 0;
  HalfRunner* runner_ = nullptr;
  std::vector<double> inverse_, gradient_, direction_, trial_, trial_gradient_, change_, product_;
  // The last update is done with the next product. It adds to entry (i, j) of the inverse
  // weight * s_i s_j - rho * (s_i p_j + p_i s_j).
  bool pending_ = false;
  double weight_ = 0.0, rho_ = 0.0;
  std::vector<double> update_step_, update_product_;  // s, p
  double step_ = 1.0;
  double trial_value_ = 0.0;
};

inline Report Bfgs::minimize(Objective& objective, int d, double* q, const double* fallback,
                             const Termination& stop) {
  d_ = d;
  runner_ = objective.half_runner();
  Report report{Status::max_iterations, 0, 1, 0.0, 0.0};
  report.value = objective.value_and_gradient(q, gradient_.data());
  report.gradient_norm = std::sqrt(dot(gradient_.data(), gradient_.data(), d_));
  if (!std::isfinite(report.value) || !std::isfinite(report.gradient_norm)) {
    report.status = Status::not_finite;
    return report;
  }
  set_direction();
  bool pristine = false;
  int idle_steps = 0;  // consecutive accepted steps that did not change the value
  while (report.iterations < stop.max_iterations) {
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
      const bool unmoved = pristine || report.iterations == 0;
      if (unmoved && terminates(stop, report, 0.0, 0.0, std::sqrt(dot(q, q, d_)))) {
        report.status = Status::converged;
        break;
      }
      if (pristine) {
        report.status = Status::line_search_failed;
        break;
      }
      start_from(d_, fallback);
      set_direction();
      pristine = true;
      continue;
    }
    ++report.iterations;
    const double decrease = report.value - trial_value_;
    report.value = trial_value_;
    idle_steps = decrease > 0.0 ? 0 : idle_steps + 1;
    const double step = step_ * std::sqrt(dot(direction_.data(), direction_.data(), d_));
    advance();
    pristine = false;
    std::copy_n(trial_.begin(), d_, q);
    gradient_.swap(trial_gradient_);
    report.gradient_norm = std::sqrt(dot(gradient_.data(), gradient_.data(), d_));
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
  // After a step that had to be shortened, the next full steps would often be too long as well, so
  // the first trial is the power 3/4 of the previous step, which returns to one.
  step_ = std::min(1.0, std::sqrt(step_ * std::sqrt(step_)));
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
      const bool usable = finite && near == 0.0;
      step_ = usable ? std::clamp(parabola, 0.1 * step_, 0.5 * step_) : 0.5 * (near + far);
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

/// product_ = inverse * gradient, after the pending update.
inline void Bfgs::multiply(const double* gradient) {
  const std::size_t d = d_;
  run_halves(runner_, d * d, [&](int half) {
    for (int i = half * d_ / 2; i < (half + 1) * d_ / 2; ++i) {
      double* row = inverse_.data() + i * d;
      if (pending_) {
        const double s = update_step_[i], p = update_product_[i];
        const double of_step = weight_ * s - rho_ * p, of_product = -rho_ * s;
        for (int j = 0; j < d_; ++j)
          row[j] += of_step * update_step_[j] + of_product * update_product_[j];
      }
      product_[i] = dot(row, gradient, d_);
    }
  });
  pending_ = false;
}

/// Sets the direction and the step for the first line search.
inline void Bfgs::set_direction() {
  multiply(gradient_.data());
  for (int i = 0; i < d_; ++i) direction_[i] = -product_[i];
  step_ = 1.0;
}

/// Updates the inverse H by H += (1 + y.Hy / s.y) s s^T / s.y - (Hy s^T + s (Hy)^T) / s.y, with s
/// the accepted step and y the change of the gradient, and sets the direction at the trial point,
/// -H g. The old direction is -H times the old gradient, so that H g also gives H y.
inline void Bfgs::advance() {
  multiply(trial_gradient_.data());
  for (int i = 0; i < d_; ++i) change_[i] = trial_gradient_[i] - gradient_[i];
  const double sy = step_ * dot(direction_.data(), change_.data(), d_);
  const double yy = dot(change_.data(), change_.data(), d_);
  const double ss = step_ * step_ * dot(direction_.data(), direction_.data(), d_);
  // Without enough curvature (possible only if the search ended early) the old inverse is kept.
  if (!(sy > 1e-14 * std::sqrt(ss * yy))) {
    for (int i = 0; i < d_; ++i) direction_[i] = -product_[i];
    return;
  }
  for (int i = 0; i < d_; ++i) {
    update_step_[i] = step_ * direction_[i];
    update_product_[i] = product_[i] + direction_[i];
  }
  rho_ = 1.0 / sy;
  weight_ = rho_ * (1.0 + rho_ * dot(change_.data(), update_product_.data(), d_));
  pending_ = true;
  const double along_step = dot(update_step_.data(), trial_gradient_.data(), d_);
  const double along_product = dot(update_product_.data(), trial_gradient_.data(), d_);
  const double of_step = weight_ * along_step - rho_ * along_product;
  for (int i = 0; i < d_; ++i)
    direction_[i] =
        -(product_[i] + of_step * update_step_[i] - rho_ * along_step * update_product_[i]);
}

}  // namespace snapspace::online
