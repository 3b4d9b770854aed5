#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace snapspace::online {

/// Vertices of a probe that handles hold by springs.
struct ProbePins {
  int count = 0;
  const std::int32_t* places = nullptr;  ///< indices among the vertices that the probe knows
  const std::int32_t* handles = nullptr;
  const double* pulls = nullptr;  ///< twice the weights of the springs
  const double* arms = nullptr;   ///< count x 3, from the handle's centroid at rest
};

/// The gradient of the energy of these springs, a sum of two parts.
class PinSprings {
 public:
  /// Copies all arrays.
  explicit PinSprings(const ProbePins& pins)
      : places_(pins.places, pins.places + pins.count),
        handles_(pins.handles, pins.handles + pins.count),
        pulls_(pins.pulls, pins.pulls + pins.count),
        arms_(pins.arms, pins.arms + 3 * static_cast<std::size_t>(pins.count)) {}

  /// Adds the part that depends on the displacements (3 per vertex).
  void add_pulls(const double* displacement, double* gradient) const {
    for (std::size_t i = 0; i < places_.size(); ++i)
      for (std::size_t e = 3 * static_cast<std::size_t>(places_[i]), a = 0; a < 3; ++a)
        gradient[e + a] += pulls_[i] * displacement[e + a];
  }

  /// Subtracts the part that depends on the handles' targets: arms moved by offsets (handles x 12).
  void subtract_wanted(const double* offsets, double* gradient) const {
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const double* arm = arms_.data() + 3 * i;
      const double* row = offsets + 12 * static_cast<std::size_t>(handles_[i]);
      for (std::size_t e = 3 * static_cast<std::size_t>(places_[i]), a = 0; a < 3; ++a, row += 4)
        gradient[e + a] -=
            pulls_[i] * (row[0] * arm[0] + row[1] * arm[1] + row[2] * arm[2] + row[3]);
    }
  }

 private:
  std::vector<std::int32_t> places_, handles_;
  std::vector<double> pulls_, arms_;
};

}  // namespace snapspace::online
