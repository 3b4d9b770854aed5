#pragma once
#include <algorithm>
#include <cstddef>

namespace snapspace::online {

/// shape = tau + sum_i q_i mode_i.
///
/// Reads every mode once, in blocks whose sums stay in the first-level cache: the time is that of
/// reading the basis.
/// @param modes  dimension x size, row-major
inline void reconstruct(std::size_t size, int dimension, const double* tau, const double* modes,
                        const double* q, double* shape) {
  constexpr std::size_t kBlock = 2048;
  for (std::size_t begin = 0; begin < size; begin += kBlock) {
    const std::size_t count = std::min(kBlock, size - begin);
    double* __restrict sum = shape + begin;
    std::copy_n(tau + begin, count, sum);
    int i = 0;
    for (; i + 4 <= dimension; i += 4) {  // four modes a pass: fewer reads and writes of the sums
      const double* m0 = modes + static_cast<std::size_t>(i) * size + begin;
      const double* m1 = m0 + size;
      const double* m2 = m1 + size;
      const double* m3 = m2 + size;
      const double q0 = q[i], q1 = q[i + 1], q2 = q[i + 2], q3 = q[i + 3];
      for (std::size_t k = 0; k < count; ++k)
        sum[k] += (q0 * m0[k] + q1 * m1[k]) + (q2 * m2[k] + q3 * m3[k]);
    }
    for (; i < dimension; ++i) {
      const double* mode = modes + static_cast<std::size_t>(i) * size + begin;
      for (std::size_t k = 0; k < count; ++k) sum[k] += q[i] * mode[k];
    }
  }
}

}  // namespace snapspace::online
