#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace snapspace::online {

/// Where a drag along a straight line of inputs arrives next: on the parabola through its last
/// three frames. Inputs are what a frame sets, in one unit: weights of poses, or the handles' pull.
/// A solve from there takes about half the evaluations of one from the last frame.
///
/// Takes no memory after construction.
class DragExtrapolation {
 public:
  DragExtrapolation(int capacity, int inputs)
      : size_(inputs),
        frames_{Frame(capacity, inputs), Frame(capacity, inputs), Frame(capacity, inputs)} {}

  /// Forgets all frames.
  void clear() { count_ = 0; }

  /// Moves q (d) on to these inputs, if it is the last frame and the way there goes on as
  /// it came; otherwise q stays.
  void go_on(int d, const double* inputs, double* q) const {
    const auto& [last, first, second] = frames_;
    if (count_ < kFrames || !std::equal(q, q + d, last.q.begin())) return;
    const double a = place(first, inputs), b = place(second, inputs);
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

  /// Takes a solved frame: q (d) for inputs.
  void add(int d, const double* inputs, const double* q) {
    const bool again = count_ > 0 && std::equal(inputs, inputs + size_, frames_[0].inputs.begin());
    if (!again) {
      std::rotate(frames_, frames_ + kFrames - 1, frames_ + kFrames);
      count_ = std::min(count_ + 1, kFrames);
    }
    std::copy_n(q, d, frames_[0].q.begin());
    std::copy_n(inputs, size_, frames_[0].inputs.begin());
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
    Frame(int capacity, int inputs) : q(capacity), inputs(inputs) {}
    std::vector<double> q, inputs;
  };

  [[nodiscard]] double on_parabola(int i, double last, double first, double second) const {
    return last * frames_[0].q[i] + first * frames_[1].q[i] + second * frames_[2].q[i];
  }

  /// Where a frame is on the line from the last frame, at 0, to the inputs, at 1; NaN beside it.
  [[nodiscard]] double place(const Frame& frame, const double* inputs) const {
    double length = 0.0, along = 0.0, distance = 0.0;
    for (int k = 0; k < size_; ++k) {
      const double step = inputs[k] - frames_[0].inputs[k];
      const double away = frame.inputs[k] - frames_[0].inputs[k];
      length += step * step;
      along += step * away;
      distance += away * away;
    }
    const double beside = distance - along * along / length;
    return beside <= kBeside * kBeside * distance ? along / length : std::nan("");
  }

  /// Whether a step before is about as long as the next one, which is 1.
  static bool steady(double step) { return step > 1.0 / kMostRatio && step < kMostRatio; }

  int size_, count_ = 0;  // frames that are known, the newest first
  Frame frames_[kFrames];
};

}  // namespace snapspace::online
