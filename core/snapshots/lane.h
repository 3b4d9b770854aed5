#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "energy/negligible_strain.h"
#include "snapshots/line_search.h"
#include "snapshots/sample_queue.h"
#include "snapshots/sample_seed.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// The state of the L-BFGS solve of a lane's sample.
struct Lane {
  static constexpr int kWindow = 8;
  static constexpr int kSettling = 4;
  static constexpr double kPatience = 48.0;  // iterations
  static constexpr int kMaxShortenings = 30;
  static constexpr int kFirstRenewal = 8;  // iterations
  static constexpr double kMoved = 0.1;    // share of the displacement

  /// The outcome of a trial: the sample starts there, has moved there, or stays where it was.
  enum class TrialOutcome { refused, started, moved };

  std::optional<Sample> sample;
  std::shared_ptr<const SampleSeed> seed;  // null if the objective's is the same everywhere
  bool fresh = false;                      // the start itself is evaluated next
  bool restarted = false;                  // since the last accepted step
  bool done = false;
  int iterations = 0;
  int evaluations = 0;
  int shortenings = 0;
  double value = 0.0;
  double norm = 0.0;   // norm of the gradient
  double scale = 1.0;  // A^-1 is applied to the next gradient divided by this
  double slope = 0.0;  // gradient . direction, negative
  double step = 1.0;
  double decreases[kWindow] = {};     // decreases in the last accepted steps
  double directions[kSettling] = {};  // lengths of the last steps, as if all were full
  double displacement = 0.0;          // its length
  double path = 0.0;                  // length of the steps since the seed was made
  int next_seed = kFirstRenewal;      // iterations before another one
  SolveStatus status = SolveStatus::cancelled;
  std::chrono::steady_clock::time_point begin;

  [[nodiscard]] bool busy() const { return sample.has_value(); }
  [[nodiscard]] bool running() const { return busy() && !done; }
  [[nodiscard]] int id() const { return sample->id; }

  void finish(SolveStatus result) {
    status = result;
    done = true;
  }

  /// Accepts or refuses a trial, and chooses a shorter step if it is refused.
  /// @param trial_slope  gradient at the trial . direction
  /// @param step_square  squared length of the step to the trial
  /// @param trial_square  squared length of the displacement there
  /// @param rounding     relative error of a value
  TrialOutcome judge(double trial_value, double trial_slope, double step_square,
                     double trial_square, double rounding) {
    if (!running()) return TrialOutcome::refused;
    ++evaluations;
    if (fresh) {
      fresh = false;
      value = trial_value;
      step = 1.0;
      if (std::isfinite(value)) return TrialOutcome::started;
      finish(SolveStatus::not_finite);
      return TrialOutcome::refused;
    }
    if (sufficient_decrease(value, slope, step, trial_value, trial_slope, rounding)) {
      record(value - trial_value, std::sqrt(step_square) / step, std::sqrt(trial_square));
      restarted = false;
      value = trial_value;
      shortenings = 0;
      // Far from the minimum the material stiffens along every direction, and for a while accepted
      // steps are about a tenth. So searches begin near the last accepted length: on the Dragon
      // that takes 155 evaluations instead of 250, and growth by 1.4 takes a tenth fewer than
      // growth by 2.
      step = std::min(1.0, 1.4 * step);
      return TrialOutcome::moved;
    }
    step = shorter_step(value, slope, step, trial_value, trial_slope);
    if (++shortenings > kMaxShortenings) finish(SolveStatus::line_search_failed);
    return TrialOutcome::refused;
  }

  [[nodiscard]] SolveReport report() const {
    SolveReport result;
    result.status = status;
    result.iterations = iterations;
    result.evaluations = evaluations;
    result.value = value;
    result.gradient_norm = norm;
    result.decrement = -slope;
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }

  /// Whether the sample has moved so far from where its seed was made that a new seed pays.
  [[nodiscard]] bool needs_seed() const {
    return seed && iterations >= next_seed && path > kMoved * displacement;
  }

  void record(double decrease, double direction, double length) {
    decreases[iterations % kWindow] = decrease;
    directions[iterations % kSettling] = direction;
    displacement = length;
    path += direction * step;
    ++iterations;
  }

  /// Scales are powers of two near the norm. Gradients in any unit are then within the range of
  /// single precision, and their digits do not change.
  void accept_norm(double gradient_norm) {
    norm = gradient_norm;
    scale_near(norm);
  }
  /// A lane of an objective with this negligible energy. Before a norm is known, the scale is near
  /// the root of the energy of a strain of one: the gradient times its image under A^-1 is an
  /// energy, which would leave the range in units far from the body's size.
  [[nodiscard]] static Lane expecting(double negligible) {
    Lane lane;
    lane.scale_near(std::sqrt(negligible) / kNegligibleStrain);
    return lane;
  }

  void scale_near(double size) {
    if (size > 0.0 && std::isfinite(size))
      scale = std::ldexp(1.0, std::clamp(std::ilogb(size), -100, 100));
  }

  /// Whether the solution is estimated to be near: as far as a window of steps as long as the last
  /// few would reach. Directions count, not steps: short steps along long directions are no sign of
  /// a near solution.
  /// A few samples crawl along flat valleys, and in the end the whole run waits for them. So the
  /// share grows for samples that take long: on the Dragon that saves a tenth of all evaluations,
  /// and the subspace of 300 samples stays as good.
  [[nodiscard]] bool settled(double share) const {
    if (iterations < kSettling) return false;
    const double late = std::max(1.0, iterations / kPatience);
    const double recent = std::accumulate(directions, directions + kSettling, 0.0) / kSettling;
    return recent * kWindow < share * late * late * displacement;
  }

  /// A single small predicted decrease may be chance: the mean of the last actual decreases must be
  /// small as well.
  [[nodiscard]] bool converged(double tolerance, double negligible) const {
    const double threshold = std::max(tolerance * std::abs(value), negligible);
    return -slope <= threshold && recent_decrease() <= threshold * kWindow;
  }

  /// Whether rounding has stopped the sample: its last steps together have decreased the value by
  /// no more than the relative error of a value. In single precision that happens on soft bodies.
  /// In double precision tolerances down to 1e-14 are met after such steps.
  [[nodiscard]] bool stalled(double rounding) const {
    return iterations >= kWindow && recent_decrease() <= rounding * std::abs(value);
  }

  /// How much the last window of steps together has decreased the value.
  [[nodiscard]] double recent_decrease() const {
    return std::accumulate(decreases, decreases + kWindow, 0.0);
  }
};

}  // namespace snapspace
