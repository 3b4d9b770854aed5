#include "snapshots/newton.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "snapshots/interpolation_system.h"
#include "snapshots/line_search.h"
#include "snapshots/posing_system.h"

namespace snapspace {

namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// y += scale * x
void add_scaled(std::vector<double>& y, double scale, const std::vector<double>& x) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += scale * x[i];
}

/// Relative decrement below which the minimum is near enough for the unclamped Hessian.
constexpr double kNearMinimum = 1e-2;

}  // namespace

template <class Objective>
Newton<Objective>::Newton(Objective objective, const SolveOptions& options, double clamp)
    : objective_(std::move(objective)),
      options_(options),
      clamp_(clamp),
      hessian_(objective_.hessian_pattern()) {
  for (auto* v : {&u_, &gradient_, &direction_, &trial_, &trial_gradient_, &residual_,
                  &preconditioned_, &search_, &product_})
    v->resize(objective_.size());
}

template <class Objective>
SolveReport Newton<Objective>::solve(int sample, const double* start, const SolveControl& control) {
  const auto begin = std::chrono::steady_clock::now();
  SolveReport report;
  objective_.load(0, sample);
  u_.assign(start, start + u_.size());
  report.value = objective_.value_and_gradient(u_.data(), gradient_.data());
  report.evaluations = 1;
  double previous_decrement = std::numeric_limits<double>::infinity();
  while (!control.cancelled) {
    if (!std::isfinite(report.value)) {
      report.status = SolveStatus::not_finite;
      break;
    }
    // Elements that stay below the clamping threshold at the minimum make the clamped Hessian a
    // wrong one, with linear and often very slow convergence. Once the minimum is near, the Hessian
    // itself is used.
    const bool near = previous_decrement < kNearMinimum * std::abs(report.value);
    objective_.assemble(u_.data(), near ? kUnclamped : clamp_, hessian_);
    // Loose systems far from the minimum, tight ones near it (Eisenstat & Walker 1996): the
    // relative decrement of the last step tells which.
    const double scale = std::max(std::abs(report.value), 1e-300);
    const double forcing =
        report.iterations == 0 ? 0.1 : std::clamp(std::sqrt(previous_decrement / scale), 1e-3, 0.1);
    const double slope = -find_direction(forcing, control);
    if (control.cancelled) break;  // the direction may be half done
    report.decrement = previous_decrement = -slope;
    if (-slope <= std::max(options_.tolerance * std::abs(report.value), objective_.negligible())) {
      report.status = SolveStatus::converged;
      break;
    }
    if (report.iterations >= options_.max_iterations) {
      report.status = SolveStatus::max_iterations;
      break;
    }
    if (!line_search(report, slope)) {
      report.status = SolveStatus::line_search_failed;
      break;
    }
    ++report.iterations;
  }
  report.gradient_norm = std::sqrt(dot(gradient_, gradient_));
  report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report;
}

/// Preconditioned conjugate gradients on H d = -g, until the residual in the inverse-factor norm
/// has fallen by the given ratio. The clamped Hessian may still have negative curvature: the
/// iterate before such a direction is a descent direction and is kept (Nocedal & Wright 2006,
/// alg. 7.1). Returns -g.d.
template <class Objective>
double Newton<Objective>::find_direction(double relative_residual, const SolveControl& control) {
  constexpr int kMaxIterations = 1000;
  std::fill(direction_.begin(), direction_.end(), 0.0);
  for (std::size_t i = 0; i < gradient_.size(); ++i) residual_[i] = -gradient_[i];
  objective_.precondition(residual_.data(), preconditioned_.data(), product_.data());
  search_ = preconditioned_;
  double norm = dot(residual_, preconditioned_);
  const double goal = norm * relative_residual * relative_residual;
  for (int iteration = 0; iteration < kMaxIterations && norm > goal && !control.cancelled;
       ++iteration) {
    hessian_.multiply(search_.data(), product_.data());
    ++linear_iterations_;
    const double curvature = dot(search_, product_);
    if (curvature <= 0.0) {
      if (iteration == 0) direction_ = search_;
      break;
    }
    const double step = norm / curvature;
    add_scaled(direction_, step, search_);
    add_scaled(residual_, -step, product_);
    objective_.precondition(residual_.data(), preconditioned_.data(), product_.data());
    const double next = dot(residual_, preconditioned_);
    const double ratio = next / norm;
    norm = next;
    for (std::size_t i = 0; i < search_.size(); ++i)
      search_[i] = preconditioned_[i] + ratio * search_[i];
  }
  return -dot(gradient_, direction_);
}

template <class Objective>
bool Newton<Objective>::line_search(SolveReport& report, double slope) {
  constexpr int kMaxShortenings = 30;
  double step = 1.0;
  for (int shortening = 0; shortening <= kMaxShortenings; ++shortening) {
    for (std::size_t i = 0; i < u_.size(); ++i) trial_[i] = u_[i] + step * direction_[i];
    const double value = objective_.value_and_gradient(trial_.data(), trial_gradient_.data());
    const double trial_slope = dot(trial_gradient_, direction_);
    ++report.evaluations;
    if (sufficient_decrease(report.value, slope, step, value, trial_slope)) {
      u_.swap(trial_);
      gradient_.swap(trial_gradient_);
      report.value = value;
      return true;
    }
    step = shorter_step(report.value, slope, step, value, trial_slope);
  }
  return false;
}

template class Newton<PosingObjective<double>>;
template class Newton<InterpolationObjective<double>>;

}  // namespace snapspace
