#pragma once
#include <algorithm>
#include <chrono>

namespace snapspace {

/// Shortest of several runs of work(), in seconds: the time when nothing disturbs the machine.
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

}  // namespace snapspace
