#include "snapshots/newton.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "snapshots/interpolation_system.h"
#include "snapshots/line_search.h"
#include "snapshots/posing_system.h"

namespace snapspace {

namespace {

/// Relative decrement below which the minimum is near enough for the unclamped Hessian.
constexpr double kNearMinimum = 1e-2;

}  // namespace

template <class Objective>
Newton<Objective>::Newton(Objective objective, const SolveOptions& options, double clamp)
    : objective_(std::move(objective)),
      options_(options),
      clamp_(clamp),
      hessian_(objective_.hessian_pattern()),
      conjugate_gradients_(objective_.size()) {
  for (auto* v : {&u_, &gradient_, &direction_, &trial_, &trial_gradient_})
    v->resize(objective_.size());
}

template <class Objective>
SolveReport Newton<Objective>::solve(const Sample& sample, const SolveControl& control) {
  const auto begin = std::chrono::steady_clock::now();
  SolveReport report;
  objective_.load(0, sample.input.data());
  u_ = sample.start;
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

/// Solves H d = -g as far as it pays; returns -g.d.
template <class Objective>
double Newton<Objective>::find_direction(double relative_residual, const SolveControl& control) {
  constexpr int kMaxIterations = 1000;
  linear_iterations_ += conjugate_gradients_.solve(
      gradient_, relative_residual, kMaxIterations,
      [&](const double* v, double* product) { hessian_.multiply(v, product); },
      [&](const double* v, double* result) { objective_.precondition(v, result); },
      [&] { return control.cancelled.load(); }, direction_);
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
