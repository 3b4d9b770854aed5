#pragma once
#include "simd/memory.h"

namespace snapspace {

/// sum_i a_i b_i. The order of summation depends on the build's pack, never on the addresses.
inline double dot(const double* a, const double* b, int n) {
  using Numbers = Lanes<kWideLanes>;
  Numbers sums(0.0);
  int i = 0;
  for (; i + kWideLanes <= n; i += kWideLanes)
    sums += load<kWideLanes>(a + i) * load<kWideLanes>(b + i);
  double sum;
  lane_sums<1>(&sums, &sum);
  for (; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

/// y += factor * x.
inline void add_scaled(double factor, const double* __restrict x, double* __restrict y, int n) {
  for (int i = 0; i < n; ++i) y[i] += factor * x[i];
}

}  // namespace snapspace
