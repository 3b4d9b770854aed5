#pragma once
#include <cmath>

namespace snapspace {

/// A power of two near a size, as a unit in which no digit changes; one for no size, or one that is
/// not finite.
inline double power_of_two(double size) {
  return size > 0.0 && std::isfinite(size) ? std::ldexp(1.0, std::ilogb(size)) : 1.0;
}

}  // namespace snapspace
