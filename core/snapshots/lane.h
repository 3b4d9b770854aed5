#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "snapshots/sample_queue.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// How far the L-BFGS solve of a lane's sample is.
struct Lane {
  static constexpr int kWindow = 8;

  std::optional<Sample> sample;
  bool fresh = false;      // the start itself is evaluated next
  bool restarted = false;  // since the last accepted step
  bool done = false;
  int iterations = 0;
  int evaluations = 0;
  int shortenings = 0;
  double value = 0.0;
  double norm = 0.0;   // of the gradient
  double scale = 1.0;  // A^-1 is applied to the next gradient over this
  double slope = 0.0;  // gradient . direction, negative
  double step = 1.0;
  double decreases[kWindow] = {};   // of the last accepted steps
  double directions[kWindow] = {};  // their directions' lengths, as if all steps were full ones
  double displacement = 0.0;        // length of the sample's
  SolveStatus status = SolveStatus::cancelled;
  std::chrono::steady_clock::time_point begin;

  [[nodiscard]] bool busy() const { return sample.has_value(); }
  [[nodiscard]] bool running() const { return busy() && !done; }
  [[nodiscard]] int id() const { return sample->id; }

  void record(double decrease, double direction, double length) {
    decreases[iterations % kWindow] = decrease;
    directions[iterations % kWindow] = direction;
    displacement = length;
    ++iterations;
  }

  /// Scales are powers of two near the norm: gradients in any unit are within the range of single
  /// precision then, and their digits do not change.
  void accept_norm(double gradient_norm) {
    norm = gradient_norm;
    if (norm > 0.0 && std::isfinite(norm))
      scale = std::ldexp(1.0, std::clamp(std::ilogb(norm), -100, 100));
  }

  /// A step says how far the solution may still be. Short steps along long directions are no sign
  /// of a near solution, which is why directions count.
  [[nodiscard]] bool settled(double share) const {
    if (iterations < kWindow) return false;
    return std::accumulate(directions, directions + kWindow, 0.0) < share * displacement;
  }

  /// A single small predicted decrease may be luck: the mean of the last actual ones must be
  /// small as well.
  [[nodiscard]] bool converged(double tolerance, double negligible) const {
    const double enough = std::max(tolerance * std::abs(value), negligible);
    if (-slope > enough) return false;
    const double recent = std::accumulate(decreases, decreases + kWindow, 0.0);
    return recent <= enough * kWindow;
  }
};

}  // namespace snapspace
