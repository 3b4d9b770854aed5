#include "snapshots/newton.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "snapshots/line_search.h"

namespace snapspace {

namespace {

/// Relative decrement below which the minimum is near enough for the Hessian itself.
constexpr double kNearMinimum = 1e-2;

}  // namespace

Newton::Newton(const SampleSystem& system, const SolveOptions& options,
               const HessianOptions& hessian)
    : system_(system),
      options_(options),
      hessian_options_(hessian),
      objective_(system.objective()),
      hessian_(system.hessian_pattern()),
      conjugate_gradients_(system.size()) {
  for (auto* v : {&u_, &gradient_, &direction_, &trial_, &trial_gradient_})
    v->resize(system.size());
}

SolveReport Newton::solve(const Sample& sample, const SolveControl& control) {
  const auto begin = std::chrono::steady_clock::now();
  SolveReport report;
  objective_->load(0, sample.input.data());
  u_ = sample.start;
  report.value = value_and_gradient(u_, gradient_);
  report.evaluations = 1;
  double previous_decrement = std::numeric_limits<double>::infinity();
  while (!control.cancelled) {
    if (!std::isfinite(report.value)) {
      report.status = SolveStatus::not_finite;
      break;
    }
    // If elements are projected at the minimum, the projected Hessian is wrong there, and
    // convergence is linear and often very slow. Once the minimum is near, the Hessian itself is
    // used.
    HessianOptions options = hessian_options_;
    if (previous_decrement < kNearMinimum * std::abs(report.value))
      options.projection = Projection::none;
    system_.assemble(sample.input.data(), u_.data(), options, hessian_);
    // Loose tolerances far from the minimum, tight ones near it (Eisenstat & Walker 1996), by the
    // relative decrement of the last step.
    const double scale = std::max(std::abs(report.value), 1e-300);
    const double forcing =
        report.iterations == 0 ? 0.1 : std::clamp(std::sqrt(previous_decrement / scale), 1e-3, 0.1);
    const double slope = -find_direction(forcing, control);
    if (control.cancelled) break;  // the direction may be incomplete
    report.decrement = previous_decrement = -slope;
    if (-slope <= std::max(options_.tolerance * std::abs(report.value), objective_->negligible())) {
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

/// Solves H d = -g to the relative residual; returns -g.d.
double Newton::find_direction(double relative_residual, const SolveControl& control) {
  constexpr int kMaxIterations = 1000;
  linear_iterations_ += conjugate_gradients_.solve(
      gradient_, relative_residual, kMaxIterations,
      [&](const double* v, double* product) { hessian_.multiply(v, product); },
      [&](const double* v, double* result) { objective_->precondition(v, result); },
      [&] { return control.cancelled.load(); }, direction_);
  return -dot(gradient_, direction_);
}

bool Newton::line_search(SolveReport& report, double slope) {
  constexpr int kMaxShortenings = 30;
  LineTrial last;
  const bool found = search_line(report.value, slope, kMaxShortenings, 0.1, [&](double step) {
    for (std::size_t i = 0; i < u_.size(); ++i) trial_[i] = u_[i] + step * direction_[i];
    ++report.evaluations;
    last.value = value_and_gradient(trial_, trial_gradient_);
    last.slope = dot(trial_gradient_, direction_);
    return last;
  });
  if (!found) return false;
  u_.swap(trial_);
  gradient_.swap(trial_gradient_);
  report.value = last.value;
  return true;
}

double Newton::value_and_gradient(const std::vector<double>& u, std::vector<double>& gradient) {
  SweepVisitor idle;
  return objective_->value_and_gradient(u.data(), gradient.data(), idle);
}

}  // namespace snapspace
