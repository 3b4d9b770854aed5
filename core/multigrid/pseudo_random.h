#pragma once
#include <cstdint>

namespace snapspace {

/// Numbers in [-1, 1), the same on every machine, for the start vectors of iterations.
class PseudoRandom {
 public:
  double operator()() {
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<double>(state_ >> 8) / (1 << 23) - 1.0;
  }

 private:
  std::uint32_t state_ = 1;
};

}  // namespace snapspace
