#pragma once
#include <algorithm>
#include <cstddef>

namespace snapspace::online {

/// sums (length) += sum_i q_i mode_i. Takes four modes per pass, to save reads and writes of the
/// sums.
/// @param modes  count x length, with `stride` entries from one mode to the next
/// @tparam Entry  type of a mode's entries; integers may count units that are factors of q
template <class Entry, class Real>
inline void add_modes(const Entry* modes, std::size_t stride, int count, const double* q,
                      std::size_t length, Real* __restrict sums) {
  const auto term = [](Real factor, Entry entry) { return factor * static_cast<Real>(entry); };
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    const Entry* m0 = modes + static_cast<std::size_t>(i) * stride;
    const Entry *m1 = m0 + stride, *m2 = m1 + stride, *m3 = m2 + stride;
    const auto q0 = static_cast<Real>(q[i]), q1 = static_cast<Real>(q[i + 1]),
               q2 = static_cast<Real>(q[i + 2]), q3 = static_cast<Real>(q[i + 3]);
    for (std::size_t k = 0; k < length; ++k)
      sums[k] += (term(q0, m0[k]) + term(q1, m1[k])) + (term(q2, m2[k]) + term(q3, m3[k]));
  }
  for (; i < count; ++i) {
    const Entry* mode = modes + static_cast<std::size_t>(i) * stride;
    const auto factor = static_cast<Real>(q[i]);
    for (std::size_t k = 0; k < length; ++k) sums[k] += term(factor, mode[k]);
  }
}

/// shape = tau + sum_i q_i mode_i.
/// Reads each mode once, in blocks whose sums stay in the first-level cache, and so takes the time
/// of reading the basis.
/// @param modes  dimension x size, row-major
template <class Entry>
inline void reconstruct(std::size_t size, int dimension, const double* tau, const Entry* modes,
                        const double* q, double* shape) {
  constexpr std::size_t kBlock = 2048;
  for (std::size_t begin = 0; begin < size; begin += kBlock) {
    const std::size_t count = std::min(kBlock, size - begin);
    std::copy_n(tau + begin, count, shape + begin);
    add_modes(modes + begin, size, dimension, q, count, shape + begin);
  }
}

}  // namespace snapspace::online
