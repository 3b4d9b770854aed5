#pragma once
/// L-BFGS in lockstep over the lanes, seeded with a fixed inverse (Nocedal & Wright 2006, alg. 7.4;
/// the seed as in Liu, Bouaziz, Kavan 2017).
///
/// Every lockstep evaluates all lanes once, each at its own trial step. A lane whose step is
/// accepted gets a new direction, one whose step is refused a shorter step; a finished lane takes
/// the next sample. Lanes never exchange anything, so the result of a sample does not depend on
/// where or beside whom it was solved.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <numeric>
#include <vector>

#include "simd/lanes.h"
#include "snapshots/line_search.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// @tparam Objective  size(), load(lane, sample), value_and_gradient(u, g), precondition(v,
/// result), all in Lanes
template <class Objective>
class LaneLbfgs {
 public:
  LaneLbfgs(Objective objective, const SolveOptions& options)
      : objective_(std::move(objective)),
        options_(options),
        size_(objective_.size()),
        u_(size_, 0.0),
        gradient_(size_, 0.0),
        direction_(size_, 0.0),
        trial_(size_, 0.0),
        trial_gradient_(size_, 0.0),
        work_(size_, 0.0),
        steps_(kMemory, std::vector<Lanes>(size_, 0.0)),
        gradient_changes_(kMemory, std::vector<Lanes>(size_, 0.0)) {
    for (Lanes& r : curvature_) r = 0.0;
  }

  /// Solves samples until `take` returns -1.
  ///
  /// @param take    () -> index of the next sample, or -1
  /// @param start   sample -> its start (3n doubles)
  /// @param finish  (sample, report, write) with write(double* shape) copying the lane's shape
  template <class Take, class Start, class Finish>
  void run(Take take, Start start, Finish finish, const SolveControl& control) {
    for (int lane = 0; lane < kLaneCount; ++lane) load(lane, take(), start);
    while (std::any_of(lanes_, lanes_ + kLaneCount, [](const Lane& l) { return l.sample >= 0; })) {
      if (control.cancelled) return;
      step();
      for (int lane = 0; lane < kLaneCount; ++lane) {
        if (lanes_[lane].sample < 0 || !lanes_[lane].done) continue;
        finish(lanes_[lane].sample, report(lane),
               [&](double* shape) { copy_lane(u_, lane, shape); });
        load(lane, take(), start);
      }
    }
  }

 private:
  static constexpr int kMemory = 8;
  static constexpr int kMaxShortenings = 30;
  static constexpr int kWindow = 8;
  using Clock = std::chrono::steady_clock;

  struct Lane {
    int sample = -1;
    bool fresh = false;  // the start itself is evaluated next
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
      const double enough = std::max(tolerance * value, negligible);
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
    forget(lane);
    const double* from = sample >= 0 ? start(sample) : nullptr;
    if (sample >= 0) objective_.load(lane, sample);
    for (int i = 0; i < size_; ++i) {
      u_[i].set(lane, from ? from[i] : 0.0);
      gradient_[i].set(lane, 0.0);
      direction_[i].set(lane, 0.0);
    }
  }

  /// Empties the lane's memory. The pairs themselves are cleared too: zero curvature times a NaN
  /// would stay NaN.
  void forget(int lane) {
    for (int k = 0; k < kMemory; ++k) {
      curvature_[k].set(lane, 0.0);
      for (int i = 0; i < size_; ++i) {
        steps_[k][i].set(lane, 0.0);
        gradient_changes_[k][i].set(lane, 0.0);
      }
    }
  }

  /// One evaluation of all lanes and what follows from it.
  void step() {
    Lanes length;
    for (int lane = 0; lane < kLaneCount; ++lane) length.set(lane, lanes_[lane].step);
    for (int i = 0; i < size_; ++i) trial_[i] = u_[i] + length * direction_[i];
    const Lanes value = objective_.value_and_gradient(trial_.data(), trial_gradient_.data());
    Lanes slope(0.0);
    for (int i = 0; i < size_; ++i) slope += trial_gradient_[i] * direction_[i];

    Lanes accepted(0.0), remembered(0.0);
    for (int lane = 0; lane < kLaneCount; ++lane) {
      const bool ok = judge(lanes_[lane], value[lane], slope[lane]);
      accepted.set(lane, ok ? 1.0 : 0.0);
      remembered.set(lane, ok && lanes_[lane].iterations > 0 ? 1.0 : 0.0);
    }
    move_and_remember(accepted, remembered);
    new_directions(accepted);
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
      lane.value = value;
      lane.shortenings = 0;
      // Far from the minimum the material stiffens along every direction and steps of a tenth are
      // the rule for a while: beginning the next search near the last accepted length saves a third
      // of all evaluations.
      lane.step = std::min(1.0, 2.0 * lane.step);
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

  /// Accepted lanes move to their trial; the pair (step, change of gradient) goes into the next
  /// slot. A refused lane writes an empty pair there: what a lane remembers must not depend on its
  /// neighbours.
  void move_and_remember(Lanes accepted, Lanes remembered) {
    newest_ = (newest_ + 1) % kMemory;
    std::vector<Lanes>& s = steps_[newest_];
    std::vector<Lanes>& y = gradient_changes_[newest_];
    Lanes sy(0.0), yy(0.0), ss(0.0);
    const Lanes zero(0.0);
    for (int i = 0; i < size_; ++i) {
      s[i] = select(remembered, trial_[i] - u_[i], zero);
      y[i] = select(remembered, trial_gradient_[i] - gradient_[i], zero);
      sy += s[i] * y[i];
      ss += s[i] * s[i];
      yy += y[i] * y[i];
      u_[i] = select(accepted, trial_[i], u_[i]);
      gradient_[i] = select(accepted, trial_gradient_[i], gradient_[i]);
    }
    for (int lane = 0; lane < kLaneCount; ++lane) {
      // Pairs of negative or vanishing curvature would make the inverse indefinite.
      const bool usable = sy[lane] > 1e-12 * std::sqrt(ss[lane] * yy[lane]);
      curvature_[newest_].set(lane, usable ? 1.0 / sy[lane] : 0.0);
    }
  }

  /// Two-loop recursion for all lanes; the accepted ones take the result.
  void new_directions(Lanes accepted) {
    Lanes alpha[kMemory];
    std::copy(gradient_.begin(), gradient_.end(), work_.begin());
    for (int age = 0; age < kMemory; ++age) {
      const int k = (newest_ - age + kMemory) % kMemory;
      alpha[k] = 0.0;
      if (empty(k)) continue;
      alpha[k] = curvature_[k] * dot(steps_[k], work_);
      for (int i = 0; i < size_; ++i) work_[i] -= alpha[k] * gradient_changes_[k][i];
    }
    objective_.precondition(work_.data(), work_.data());
    for (int age = kMemory - 1; age >= 0; --age) {
      const int k = (newest_ - age + kMemory) % kMemory;
      if (empty(k)) continue;
      const Lanes weight = alpha[k] - curvature_[k] * dot(gradient_changes_[k], work_);
      for (int i = 0; i < size_; ++i) work_[i] += weight * steps_[k][i];
    }
    Lanes slope(0.0);
    for (int i = 0; i < size_; ++i) {
      direction_[i] = select(accepted, -work_[i], direction_[i]);
      slope += gradient_[i] * direction_[i];
    }
    for (int lane = 0; lane < kLaneCount; ++lane)
      if (accepted[lane] != 0.0) test_convergence(lane, slope[lane]);
  }

  void test_convergence(int index, double slope) {
    Lane& lane = lanes_[index];
    lane.slope = slope;
    if (!std::isfinite(slope)) return finish(lane, SolveStatus::not_finite);
    if (slope > 0.0) return restart(index);
    if (lane.converged(options_.tolerance, objective_.negligible())) return finish(lane, SolveStatus::converged);
    if (lane.iterations >= options_.max_iterations) finish(lane, SolveStatus::max_iterations);
  }

  /// Rounding made an ascent direction: forget the memory and go on along the preconditioned
  /// gradient.
  void restart(int index) {
    forget(index);
    for (int i = 0; i < size_; ++i) direction_[i].set(index, 0.0);
    lanes_[index].fresh = true;
  }

  bool empty(int k) const {
    for (int lane = 0; lane < kLaneCount; ++lane)
      if (curvature_[k][lane] != 0.0) return false;
    return true;
  }

  Lanes dot(const std::vector<Lanes>& a, const std::vector<Lanes>& b) const {
    Lanes sum(0.0);
    for (int i = 0; i < size_; ++i) sum += a[i] * b[i];
    return sum;
  }

  void copy_lane(const std::vector<Lanes>& from, int lane, double* to) const {
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
  int newest_ = 0;
  Lane lanes_[kLaneCount];
  std::vector<Lanes> u_, gradient_, direction_, trial_, trial_gradient_, work_;
  std::vector<std::vector<Lanes>> steps_, gradient_changes_;  // s and y of the textbook
  Lanes curvature_[kMemory];  // 1 / s.y, zero where there is no pair
};

}  // namespace snapspace
