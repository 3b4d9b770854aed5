#pragma once
#include <cmath>

namespace snapspace::online {

/// The polynomial of degree four with given value, slope and curvature at 0, and value and slope at
/// 1. A quartic objective is such a polynomial along any line, so a single evaluation of it gives
/// the exact minimisers on the line.
class LineQuartic {
 public:
  LineQuartic(double value, double slope, double curvature, double end_value, double end_slope)
      : slope_(slope), curvature_(curvature) {
    const double rise = end_value - value - slope - 0.5 * curvature;
    const double tilt = end_slope - slope - curvature;
    cubic_ = 4.0 * rise - tilt;
    quartic_ = tilt - 3.0 * rise;
  }

  /// The first point in (begin, end] where the slope is no longer negative; `end` if there is none.
  [[nodiscard]] double first_minimum(double begin, double end) const {
    constexpr int kParts = 16, kHalvings = 20;
    for (int part = 1; part <= kParts; ++part) {
      double far = begin + (end - begin) * part / kParts;
      if (!(slope_at(far) >= 0.0)) continue;
      double near = begin + (end - begin) * (part - 1) / kParts;
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (near + far);
        (slope_at(middle) < 0.0 ? near : far) = middle;
      }
      return far;
    }
    return end;
  }

 private:
  [[nodiscard]] double slope_at(double t) const {
    return slope_ + t * (curvature_ + t * (3.0 * cubic_ + t * 4.0 * quartic_));
  }

  double slope_, curvature_, cubic_, quartic_;
};

}  // namespace snapspace::online
