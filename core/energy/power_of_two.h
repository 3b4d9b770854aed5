#pragma once
#include <cmath>

namespace snapspace {

/// A power of two near a size, as a unit that changes no digits; 1 if the size is not positive or
/// not finite.
inline double power_of_two(double size) {
  return size > 0.0 && std::isfinite(size) ? std::ldexp(1.0, std::ilogb(size)) : 1.0;
}

}  // namespace snapspace
