#pragma once
/// L-BFGS in lockstep over the lanes, seeded with a fixed inverse (Nocedal & Wright 2006, alg. 7.4;
/// the seed as in Liu, Bouaziz, Kavan 2017).
///
/// Every lockstep evaluates all lanes once, each at its own trial step. A lane whose step is
/// accepted gets a new direction, one whose step is refused a shorter step; a finished lane takes
/// the next sample. Lanes never exchange anything, so the result of a sample does not depend on
/// where or beside whom it was solved.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "simd/lanes.h"
#include "snapshots/lbfgs_memory.h"
#include "snapshots/line_search.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// @tparam Objective  has size(), negligible(), load(lane, sample), value_and_gradient(u, g) and
///                    precondition(v, result, scratch)
template <class Objective, int Width>
class LaneLbfgs {
 public:
  using Real = Lanes<Width>;

  LaneLbfgs(Objective objective, const SolveOptions& options)
      : objective_(std::move(objective)),
        options_(options),
        size_(objective_.size()),
        memory_(size_),
        u_(size_, 0.0),
        gradient_(size_, 0.0),
        direction_(size_, 0.0),
        trial_(size_, 0.0),
        trial_gradient_(size_, 0.0),
        work_(size_, 0.0f),
        scratch_(size_, 0.0f) {}

  /// Solves samples until `take` returns -1.
  ///
  /// @param take    () -> index of the next sample, or -1
  /// @param start   sample -> its start (3n doubles)
  /// @param finish  (sample, report, write) with write(double* shape) copying the lane's shape
  template <class Take, class Start, class Finish>
  void run(Take take, Start start, Finish finish, const SolveControl& control) {
    for (int lane = 0; lane < Width; ++lane) load(lane, take(), start);
    while (std::any_of(lanes_, lanes_ + Width, [](const Lane& l) { return l.sample >= 0; })) {
      if (control.cancelled) return;
      step();
      for (int lane = 0; lane < Width; ++lane) {
        if (lanes_[lane].sample < 0 || !lanes_[lane].done) continue;
        finish(lanes_[lane].sample, report(lane),
               [&](double* shape) { copy_lane(u_, lane, shape); });
        load(lane, take(), start);
      }
    }
  }

 private:
  static constexpr int kMaxShortenings = 30;
  static constexpr int kWindow = 8;
  using Clock = std::chrono::steady_clock;

  struct Lane {
    int sample = -1;
    bool fresh = false;      // the start itself is evaluated next
    bool restarted = false;  // since the last accepted step
    bool done = false;
    int iterations = 0;
    int evaluations = 0;
    int shortenings = 0;
    double value = 0.0;
    double slope = 0.0;  // gradient . direction, negative
    double step = 1.0;
    double decreases[kWindow] = {};  // of the last accepted steps
    SolveStatus status = SolveStatus::cancelled;
    Clock::time_point begin;

    /// A single small predicted decrease may be luck: the mean of the last actual ones must be
    /// small as well.
    [[nodiscard]] bool converged(double tolerance, double negligible) const {
      const double enough = std::max(tolerance * std::abs(value), negligible);
      if (-slope > enough) return false;
      const double recent = std::accumulate(decreases, decreases + kWindow, 0.0);
      return recent <= enough * kWindow;
    }
  };

  template <class Start>
  void load(int lane, int sample, Start start) {
    lanes_[lane] = Lane{};
    lanes_[lane].sample = sample;
    lanes_[lane].fresh = true;
    lanes_[lane].begin = Clock::now();
    memory_.forget(lane);
    const double* from = sample >= 0 ? start(sample) : nullptr;
    if (sample >= 0) objective_.load(lane, sample);
    for (int i = 0; i < size_; ++i) {
      u_[i].set(lane, from ? from[i] : 0.0);
      gradient_[i].set(lane, 0.0);
      direction_[i].set(lane, 0.0);
    }
  }

  /// One evaluation of all lanes and what follows from it.
  void step() {
    Real length;
    for (int lane = 0; lane < Width; ++lane) length.set(lane, lanes_[lane].step);
    for (int i = 0; i < size_; ++i) trial_[i] = u_[i] + length * direction_[i];
    const Real value = objective_.value_and_gradient(trial_.data(), trial_gradient_.data());
    Real slope(0.0);
    for (int i = 0; i < size_; ++i) slope += trial_gradient_[i] * direction_[i];

    Real accepted(0.0), remembered(0.0);
    for (int lane = 0; lane < Width; ++lane) {
      const bool ok = judge(lanes_[lane], value[lane], slope[lane]);
      accepted.set(lane, ok ? 1.0 : 0.0);
      remembered.set(lane, ok && lanes_[lane].iterations > 0 ? 1.0 : 0.0);
    }
    memory_.move(accepted, remembered, length, trial_.data(), trial_gradient_.data(), u_.data(),
                 gradient_.data());
    memory_.first_loop(gradient_.data(), work_.data());
    objective_.precondition(work_.data(), work_.data(), scratch_.data());
    const Real slopes =
        memory_.second_loop(accepted, gradient_.data(), work_.data(), direction_.data());
    for (int lane = 0; lane < Width; ++lane)
      if (accepted[lane] != 0.0) test_convergence(lane, slopes[lane]);
  }

  /// Accepts or refuses the lane's trial, and chooses a shorter step where it is refused.
  bool judge(Lane& lane, double value, double slope) {
    if (lane.sample < 0 || lane.done) return false;
    ++lane.evaluations;
    if (lane.fresh) {
      lane.fresh = false;
      lane.value = value;
      lane.step = 1.0;
      if (!std::isfinite(value)) finish(lane, SolveStatus::not_finite);
      return !lane.done;
    }
    if (sufficient_decrease(lane.value, lane.slope, lane.step, value, slope)) {
      lane.decreases[lane.iterations % kWindow] = lane.value - value;
      ++lane.iterations;
      lane.restarted = false;
      lane.value = value;
      lane.shortenings = 0;
      // Far from the minimum the material stiffens along every direction, and for a while steps of
      // a tenth are the rule. Searches begin near the last accepted length: on the Dragon that
      // takes 155 evaluations instead of 250, and growth by 1.4 a tenth fewer than growth by 2.
      lane.step = std::min(1.0, 1.4 * lane.step);
      return true;
    }
    lane.step = shorter_step(lane.value, lane.slope, lane.step, value, slope);
    if (++lane.shortenings > kMaxShortenings) finish(lane, SolveStatus::line_search_failed);
    return false;
  }

  static void finish(Lane& lane, SolveStatus status) {
    lane.status = status;
    lane.done = true;
  }

  void test_convergence(int index, double slope) {
    Lane& lane = lanes_[index];
    lane.slope = slope;
    if (!std::isfinite(slope)) return finish(lane, SolveStatus::not_finite);
    if (slope > 0.0) return restart(index);
    if (lane.converged(options_.tolerance, objective_.negligible()))
      return finish(lane, SolveStatus::converged);
    if (lane.iterations >= options_.max_iterations) finish(lane, SolveStatus::max_iterations);
  }

  /// Rounding made an ascent direction: forget the memory and go on along the preconditioned
  /// gradient. If that ascends as well, the gradient is noise.
  void restart(int index) {
    if (lanes_[index].restarted) return finish(lanes_[index], SolveStatus::line_search_failed);
    lanes_[index].restarted = true;
    memory_.forget(index);
    for (int i = 0; i < size_; ++i) direction_[i].set(index, 0.0);
    lanes_[index].fresh = true;
  }

  void copy_lane(const std::vector<Real>& from, int lane, double* to) const {
    for (int i = 0; i < size_; ++i) to[i] = from[i][lane];
  }

  SolveReport report(int index) const {
    const Lane& lane = lanes_[index];
    double square = 0.0;
    for (int i = 0; i < size_; ++i) square += gradient_[i][index] * gradient_[i][index];
    SolveReport result;
    result.status = lane.status;
    result.iterations = lane.iterations;
    result.evaluations = lane.evaluations;
    result.value = lane.value;
    result.gradient_norm = std::sqrt(square);
    result.decrement = -lane.slope;
    result.seconds = std::chrono::duration<double>(Clock::now() - lane.begin).count();
    return result;
  }

  Objective objective_;
  SolveOptions options_;
  int size_;
  LbfgsMemory<Width> memory_;
  Lane lanes_[Width];
  std::vector<Real> u_, gradient_, direction_, trial_, trial_gradient_;
  std::vector<SingleLanes<Width>> work_, scratch_;
};

}  // namespace snapspace
