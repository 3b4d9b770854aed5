#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

namespace snapspace::online {

/// Extrapolates a drag along a straight line of inputs, on the parabola through its last three
/// frames. Inputs are the numbers that a frame sets, in one unit: weights of poses, or the handles'
/// pull. A solve from there takes about half the evaluations of one from the last frame.
/// Allocates no memory after construction.
class DragExtrapolation {
 public:
  DragExtrapolation(int capacity, int inputs)
      : size_(inputs),
        frames_{Frame(capacity, inputs), Frame(capacity, inputs), Frame(capacity, inputs)} {}

  /// Forgets all frames.
  void clear() { count_ = 0; }

  /// Whether q (d) is the last frame.
  [[nodiscard]] bool ends_at(int d, const double* q) const {
    return count_ > 0 && std::equal(q, q + d, frames_[0].q.begin());
  }

  /// Extrapolates q (d), the last frame, to these inputs if they continue its path; otherwise q is
  /// unchanged.
  void extrapolate(int d, const double* inputs, double* q) const {
    const auto& [last, first, second] = frames_;
    if (count_ < kFrames) return;
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
    if (!(bend < kMaxBend * kMaxBend * straight)) return;
    for (int i = 0; i < d; ++i) q[i] = on_parabola(i, from_last, from_first, from_second);
  }

  /// Adds a solved frame: q (d) for inputs.
  void add(int d, const double* inputs, const double* q) {
    const bool same = count_ > 0 && std::equal(inputs, inputs + size_, frames_[0].inputs.begin());
    if (!same) {
      std::rotate(frames_, frames_ + kFrames - 1, frames_ + kFrames);
      count_ = std::min(count_ + 1, kFrames);
    }
    std::copy_n(q, d, frames_[0].q.begin());
    std::copy_n(inputs, size_, frames_[0].inputs.begin());
  }

 private:
  static constexpr int kFrames = 3;
  /// Largest ratio of successive steps, in either direction; beyond it an extrapolation is only a
  /// guess.
  static constexpr double kMaxRatio = 4.0;
  /// How far frames may be off the line, as a share of their distance.
  static constexpr double kMaxOffLine = 0.05;
  /// How much the parabola may deviate from the line, as a share of its length: where a shape
  /// snaps, the parabola is wrong.
  static constexpr double kMaxBend = 0.5;

  struct Frame {
    Frame(int capacity, int inputs) : q(capacity), inputs(inputs) {}
    std::vector<double> q, inputs;
  };

  [[nodiscard]] double on_parabola(int i, double last, double first, double second) const {
    return last * frames_[0].q[i] + first * frames_[1].q[i] + second * frames_[2].q[i];
  }

  /// Position of a frame on the line from the last frame, at 0, to the inputs, at 1; NaN off the
  /// line.
  [[nodiscard]] double place(const Frame& frame, const double* inputs) const {
    double length = 0.0, along = 0.0, distance = 0.0;
    for (int k = 0; k < size_; ++k) {
      const double step = inputs[k] - frames_[0].inputs[k];
      const double away = frame.inputs[k] - frames_[0].inputs[k];
      length += step * step;
      along += step * away;
      distance += away * away;
    }
    const double off_line = distance - along * along / length;
    return off_line <= kMaxOffLine * kMaxOffLine * distance ? along / length : std::nan("");
  }

  /// Whether a previous step is about as long as the next one, which has length 1.
  static bool steady(double step) { return step > 1.0 / kMaxRatio && step < kMaxRatio; }

  int size_, count_ = 0;  // numbers of inputs and of known frames; the newest is first
  Frame frames_[kFrames];
};

}  // namespace snapspace::online
