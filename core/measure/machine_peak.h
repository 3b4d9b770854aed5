#pragma once
#include <cstddef>

namespace snapspace {

/// Floating-point operations per second of one thread: independent products and sums in registers.
/// An upper bound for any kernel of this precision in this build.
[[nodiscard]] double peak_flops(bool single, int repeats);

/// Bytes per second that one thread reads from an array of this size.
[[nodiscard]] double read_bandwidth(std::size_t bytes, int repeats);

}  // namespace snapspace
