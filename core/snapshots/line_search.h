#pragma once
#include <algorithm>
#include <cmath>

namespace snapspace {

/// Armijo's condition or, where the values no longer resolve the decrease, the approximate
/// condition of Hager & Zhang (2005), which uses slopes: near the minimum a difference of values is
/// rounding noise, while slopes are still accurate.
/// @param rounding  relative error of the values
inline bool sufficient_decrease(double value0, double slope0, double step, double value,
                                double slope, double rounding = 1e-12) {
  if (!std::isfinite(value) || !std::isfinite(slope)) return false;
  if (value <= value0 + 1e-4 * step * slope0) return true;
  const double noise = rounding * std::abs(value0);
  return value <= value0 + noise && std::abs(slope) <= 0.8 * std::abs(slope0);
}

/// Minimiser of the cubic through both ends' values and slopes, within [0.1, 0.5] * refused step.
inline double shorter_step(double value0, double slope0, double step, double value, double slope) {
  if (!std::isfinite(value) || !std::isfinite(slope)) return 0.1 * step;
  const double d1 = slope0 + slope - 3.0 * (value0 - value) / (-step);
  const double root = d1 * d1 - slope0 * slope;
  double next = 0.5 * step;
  if (root >= 0.0) {
    const double d2 = std::sqrt(root);
    const double minimiser = step - step * (slope + d2 - d1) / (slope - slope0 + 2.0 * d2);
    if (std::isfinite(minimiser)) next = minimiser;
  }
  return std::clamp(next, 0.1 * step, 0.5 * step);
}

/// Value and slope at a step of a line search.
struct LineTrial {
  double value;
  double slope;  ///< along the direction
};

/// Tries the full step, then shorter ones, until one decreases sufficiently. Returns whether one
/// did.
/// @param trial            trial(step) evaluates at a step; the last call is for the accepted step
/// @param after_infinite   factor by which a step is shortened if its value is not finite
template <class Trial>
bool search_line(double value0, double slope0, int max_shortenings, double after_infinite,
                 Trial&& trial) {
  double step = 1.0;
  for (int shortening = 0; shortening <= max_shortenings; ++shortening) {
    const LineTrial found = trial(step);
    if (sufficient_decrease(value0, slope0, step, found.value, found.slope)) return true;
    step = std::isfinite(found.value) ? shorter_step(value0, slope0, step, found.value, found.slope)
                                      : after_infinite * step;
  }
  return false;
}

}  // namespace snapspace
