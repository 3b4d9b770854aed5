#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace snapspace::online {

/// Where a drag along a straight line of weights arrives next: on the parabola through its last
/// three frames. A solve from there takes half the evaluations of one from the last frame.
///
/// Takes no memory after construction.
class DragExtrapolation {
 public:
  DragExtrapolation(int capacity, int poses)
      : poses_(poses),
        frames_{Frame(capacity, poses), Frame(capacity, poses), Frame(capacity, poses)} {}

  /// Forgets all frames.
  void clear() { count_ = 0; }

  /// Moves q (d) on to these weights (poses), if it is the last frame and the way there goes on as
  /// it came; otherwise q stays.
  void go_on(int d, const double* weights, double* q) const {
    const auto& [last, first, second] = frames_;
    if (count_ < kFrames || !std::equal(q, q + d, last.q.begin())) return;
    const double a = place(first, weights), b = place(second, weights);
    if (!(steady(-a) && steady(a - b))) return;
    const double from_last = (1.0 - a) * (1.0 - b) / (a * b);
    const double from_first = (1.0 - b) / (a * (a - b)), from_second = (1.0 - a) / (b * (b - a));
    double bend = 0.0, straight = 0.0;
    for (int i = 0; i < d; ++i) {
      const double line = (first.q[i] - last.q[i]) / a;
      const double moved = on_parabola(i, from_last, from_first, from_second) - last.q[i];
      bend += (moved - line) * (moved - line);
      straight += line * line;
    }
    if (!(bend < kMostBend * kMostBend * straight)) return;
    for (int i = 0; i < d; ++i) q[i] = on_parabola(i, from_last, from_first, from_second);
  }

  /// Takes a solved frame: q (d) for weights (poses).
  void add(int d, const double* weights, const double* q) {
    const bool again =
        count_ > 0 && std::equal(weights, weights + poses_, frames_[0].weights.begin());
    if (!again) {
      std::rotate(frames_, frames_ + kFrames - 1, frames_ + kFrames);
      count_ = std::min(count_ + 1, kFrames);
    }
    std::copy_n(q, d, frames_[0].q.begin());
    std::copy_n(weights, poses_, frames_[0].weights.begin());
  }

 private:
  static constexpr int kFrames = 3;
  /// Ratio of steps that follow each other, either way: farther an extrapolation is a guess.
  static constexpr double kMostRatio = 4.0;
  /// How far frames may lie beside the line, as a share of their distance.
  static constexpr double kBeside = 0.05;
  /// How much the parabola may add to the line: where a shape snaps it knows nothing.
  static constexpr double kMostBend = 0.5;

  struct Frame {
    Frame(int capacity, int poses) : q(capacity), weights(poses) {}
    std::vector<double> q, weights;
  };

  [[nodiscard]] double on_parabola(int i, double last, double first, double second) const {
    return last * frames_[0].q[i] + first * frames_[1].q[i] + second * frames_[2].q[i];
  }

  /// Where a frame is on the line from the last frame, at 0, to the weights, at 1; NaN beside it.
  [[nodiscard]] double place(const Frame& frame, const double* weights) const {
    double length = 0.0, along = 0.0, distance = 0.0;
    for (int k = 0; k < poses_; ++k) {
      const double step = weights[k] - frames_[0].weights[k];
      const double away = frame.weights[k] - frames_[0].weights[k];
      length += step * step;
      along += step * away;
      distance += away * away;
    }
    const double beside = distance - along * along / length;
    return beside <= kBeside * kBeside * distance ? along / length : std::nan("");
  }

  /// Whether a step before is about as long as the next one, which is 1.
  static bool steady(double step) { return step > 1.0 / kMostRatio && step < kMostRatio; }

  int poses_, count_ = 0;  // frames that are known, the newest first
  Frame frames_[kFrames];
};

}  // namespace snapspace::online
