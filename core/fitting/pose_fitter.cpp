#include "fitting/pose_fitter.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "cholesky/analysis.h"
#include "snapshots/line_search.h"
#include "threads/flush_denormals.h"

namespace snapspace {

namespace {

/// Relative decrements at which a stage is good enough as a start of the next, and at which the
/// last stage ends.
constexpr double kStageTolerance = 5e-2;
constexpr double kTolerance = 1e-3;
/// Growth of the stiffness from stage to stage. The deviation falls roughly with its square root,
/// so the last growth can be chosen to end near the goal: a stiffer surface distorts the tets more.
constexpr double kMaxGrowth = 10.0;
constexpr double kMinGrowth = 1.5;
/// Largest stiffness relative to the first; no goal that can be reached needs it.
constexpr double kStiffnessLimit = 1e10;
/// A step must not raise any tet's distortion by more than this factor: tets crushed by a long step
/// take many steps to recover, and some never do.
constexpr double kMaxDistortionGrowth = 3.0;

}  // namespace

PoseFitter::PoseFitter(const FittingSystem& system, const FitOptions& options)
    : system_(system),
      options_(options),
      energy_(system.energy, options.stretch),
      hessian_(system.pattern),
      conjugate_gradients_(system.size()),
      supernodes_(analysed(scalar_matrix())) {
  for (auto* v : {&u_, &gradient_, &direction_, &trial_, &trial_gradient_})
    v->resize(system.size());
  limits_.resize(system.energy.tets());
  energies_.resize(system.energy.tets());
}

FitReport PoseFitter::fit(const double* targets, const std::vector<double>& shape,
                          const SolveControl& control) {
  const FlushDenormals flush;
  const auto begin = std::chrono::steady_clock::now();
  targets_ = targets;
  start(shape);
  while (!done_ && !control.cancelled) take_step(control);
  report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return report_;
}

/// Begins the first stage.
void PoseFitter::start(const std::vector<double>& shape) {
  report_ = {};
  report_.stages = 1;
  report_.stiffness = options_.first_stiffness;
  done_ = false;
  u_ = shape;
  energy_.evaluate(u_.data(), energies_, stresses_);
  set_limits();
  value_ = value_and_gradient(u_, gradient_);
  decrement_ = value_;
  report_.deviation = system_.springs.deviation(targets_, u_.data());
}

/// Takes one Newton step, and begins the next stage or ends if it is time.
void PoseFitter::take_step(const SolveControl& control) {
  const auto end = [&](FitStatus status) {
    report_.status = status;
    done_ = true;
  };
  hessian_.clear();
  energy_.add_hessian(u_.data(), hessian_);
  const double decrement = find_direction(control);
  if (control.cancelled) return;  // the direction may be incomplete
  decrement_ = decrement;
  const auto below = [&](double tolerance) {
    return decrement <= std::max(tolerance * value_, system_.energy.negligible());
  };
  const bool near = report_.deviation <= options_.deviation;
  if (near && below(kTolerance)) return end(FitStatus::converged);
  if (report_.iterations >= options_.max_iterations) return end(FitStatus::max_iterations);
  const bool next_stage = !near && below(kStageTolerance);
  // at a minimum there is no step to take
  if (!below(0.0)) {
    if (!line_search(-decrement)) return end(FitStatus::line_search_failed);
    ++report_.iterations;
    report_.deviation = system_.springs.deviation(targets_, u_.data());
  }
  if (next_stage && !raise_stiffness()) end(FitStatus::stiffness_limit);
}

bool PoseFitter::raise_stiffness() {
  const double ratio = report_.deviation / options_.deviation;
  report_.stiffness *= std::clamp(1.1 * ratio * ratio, kMinGrowth, kMaxGrowth);
  ++report_.stages;
  value_ = value_and_gradient(u_, gradient_);
  decrement_ = value_;
  return report_.stiffness <= kStiffnessLimit * options_.first_stiffness;
}

/// The value is also infinite if a tet exceeds its limit.
double PoseFitter::value_and_gradient(const std::vector<double>& u, std::vector<double>& gradient) {
  energy_.evaluate(u.data(), energies_, stresses_);
  std::fill(gradient.begin(), gradient.end(), 0.0);
  double value = 0.0;
  for (std::size_t t = 0; t < energies_.size(); ++t) {
    // written so that NaN is refused too
    if (!(energies_[t] <= limits_[t])) return std::numeric_limits<double>::infinity();
    value += energies_[t];
  }
  energy_.add_gradient(stresses_, gradient.data());
  return value +
         system_.springs.value_and_gradient(report_.stiffness, targets_, u.data(), gradient.data());
}

/// The distortion |F|^2 + |F^-1|^2 is 6 at rest, and the energy of a tet is volume * (distortion -
/// 6) / 4.
void PoseFitter::set_limits() {
  for (std::size_t t = 0; t < limits_.size(); ++t) {
    const double quarter = 0.25 * system_.energy.rest.tets[t].volume;
    limits_[t] = kMaxDistortionGrowth * (energies_[t] + 6.0 * quarter) - 6.0 * quarter;
  }
}

Eigen::SparseMatrix<double> PoseFitter::scalar_matrix() const {
  const auto& start = hessian_.row_start();
  const auto& columns = hessian_.columns();
  const int n = system_.energy.rest.vertex_count;
  std::vector<double> values(columns.size());
  std::transform(hessian_.blocks().begin(), hessian_.blocks().end(), values.begin(),
                 [](const auto& block) { return (block[0] + block[4] + block[8]) / 3.0; });
  const Eigen::Map<const Eigen::SparseMatrix<double>> elastic(
      n, n, static_cast<Eigen::Index>(values.size()), start.data(), columns.data(), values.data());
  return system_.springs.scalar_hessian(report_.stiffness, n) + elastic;
}

/// Solves H d = -g, loosely far from the minimum [Eisenstat & Walker 1996]; returns -g.d.
double PoseFitter::find_direction(const SolveControl& control) {
  constexpr int kMaxIterations = 500;
  const double scale = std::max(value_, system_.energy.negligible());
  const double forcing = std::clamp(std::sqrt(decrement_ / scale), 1e-2, 0.1);
  const ScalarFactor factor(scalar_matrix(), supernodes_);
  report_.linear_iterations += conjugate_gradients_.solve(
      gradient_, forcing, kMaxIterations,
      [&](const double* v, double* product) {
        hessian_.multiply(v, product);
        system_.springs.add_product(report_.stiffness, v, product);
      },
      [&](const double* v, double* result) { factor.solve(v, result); },
      [&] { return control.cancelled.load(); }, direction_);
  return -dot(gradient_, direction_);
}

bool PoseFitter::line_search(double slope) {
  constexpr int kMaxShortenings = 40;
  LineTrial last;
  // a refused tet does not say how much shorter a step must be, so the step is halved
  const bool found = search_line(value_, slope, kMaxShortenings, 0.5, [&](double step) {
    for (std::size_t i = 0; i < u_.size(); ++i) trial_[i] = u_[i] + step * direction_[i];
    ++report_.evaluations;
    last.value = value_and_gradient(trial_, trial_gradient_);
    last.slope = std::isfinite(last.value) ? dot(trial_gradient_, direction_) : 0.0;
    return last;
  });
  if (!found) return false;
  u_.swap(trial_);
  gradient_.swap(trial_gradient_);
  value_ = last.value;
  set_limits();
  return true;
}

}  // namespace snapspace
