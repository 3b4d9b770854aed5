#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <vector>

#include "simd/lanes.h"

namespace snapspace {

/// Shortest of several runs of work(), in seconds: what the machine can do when nothing disturbs.
template <class Work>
[[nodiscard]] double shortest_time(int repeats, Work&& work) {
  double best = 1e300;
  for (int k = 0; k < repeats; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    best = std::min(best, spent.count());
  }
  return best;
}

/// Floating-point operations per second of one thread: products and sums in registers that do not
/// wait for each other. The bound of any kernel of this precision on this build.
/// @param sink  keeps the compiler from leaving the work out
template <class Real>
[[nodiscard]] double peak_flops(int repeats, volatile double& sink) {
  constexpr int kChains = 12, kSteps = 200'000;
  Real sums[kChains];
  for (int i = 0; i < kChains; ++i) sums[i] = Real(static_cast<typename Real::Scalar>(i));
  // factors that the compiler does not know
  Real factor(static_cast<typename Real::Scalar>(sink)), shift(factor);
  const double seconds = shortest_time(repeats, [&] {
    for (int step = 0; step < kSteps; ++step)
      for (Real& sum : sums) sum = sum * factor + shift;
  });
  for (const Real& sum : sums) sink = sink + static_cast<double>(sum[0]);
  return 2.0 * kChains * kSteps * Real::kWidth / seconds;
}

/// Bytes per second that one thread reads from an array of this size.
[[nodiscard]] inline double read_bandwidth(std::size_t bytes, int repeats, volatile double& sink) {
  using Real = Lanes<kWideLanes>;
  const std::vector<Real> data(bytes / sizeof(Real), Real(1.0));
  // read anew each time, so that the compiler cannot know that nothing has changed
  const Real* volatile source = data.data();
  const double seconds = shortest_time(repeats, [&] {
    const Real* from = source;
    Real sums[8];
    for (Real& sum : sums) sum = Real(0.0);
    for (std::size_t i = 0; i + 8 <= data.size(); i += 8)
      for (int k = 0; k < 8; ++k) sums[k] += from[i + k];
    for (const Real& sum : sums) sink = sink + sum[0];
  });
  return static_cast<double>(data.size() * sizeof(Real)) / seconds;
}

}  // namespace snapspace
