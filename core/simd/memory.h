#pragma once
#include <cstring>

#include "simd/lanes.h"

/// Packs of neighbouring numbers of one array: loads, stores and sums. (Elsewhere a pack holds one
/// number from each of several samples.)

namespace snapspace {

/// Pack of the numbers from[0] ... from[Width - 1], at any address.
template <int Width>
inline Lanes<Width> load(const double* from) {
  Lanes<Width> pack;
  std::memcpy(&pack, from, sizeof pack);
  return pack;
}

/// The same for numbers stored in single precision; arithmetic is in double precision.
template <int Width>
inline Lanes<Width> load(const float* from) {
  SingleLanes<Width> pack;
  std::memcpy(&pack, from, sizeof pack);
  return cast<double>(pack);
}

template <int Width>
inline void store(double* to, Lanes<Width> pack) {
  std::memcpy(to, &pack, sizeof pack);
}

/// Keeps a pack in its register. Otherwise compilers fold the load into each use, and a number is
/// read three times instead of once.
template <class P>
inline void keep_in_register([[maybe_unused]] P& pack) {
#if defined(__GNUC__) && defined(__AVX__)
  asm("" : "+v"(pack.v));
#endif
}

#if defined(__has_builtin)
#if __has_builtin(__builtin_shufflevector)
#define SNAPSPACE_SHUFFLE(a, b, ...) __builtin_shufflevector(a, b, __VA_ARGS__)
#endif
#endif

/// sums[i] = sum of the lanes of packs[i], in pairs, for `Count` packs.
template <int Count, int Width>
inline void lane_sums(const Lanes<Width>* packs, double* sums) {
#ifdef SNAPSPACE_SHUFFLE
  if constexpr (Width == 8 && Count % 8 == 0) {
    for (int i = 0; i < Count; i += 8) {
      typename Lanes<Width>::Vector pairs[4],
          fours[2];  // 2 sums of 4 parts each, 4 sums of 2 parts
      for (int k = 0; k < 4; ++k) {
        const auto a = packs[i + 2 * k].v, b = packs[i + 2 * k + 1].v;
        pairs[k] = SNAPSPACE_SHUFFLE(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
                   SNAPSPACE_SHUFFLE(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
      }
      for (int k = 0; k < 2; ++k) {
        const auto a = pairs[2 * k], b = pairs[2 * k + 1];
        fours[k] = SNAPSPACE_SHUFFLE(a, b, 0, 1, 8, 9, 4, 5, 12, 13) +
                   SNAPSPACE_SHUFFLE(a, b, 2, 3, 10, 11, 6, 7, 14, 15);
      }
      store(sums + i,
            Lanes<Width>(SNAPSPACE_SHUFFLE(fours[0], fours[1], 0, 1, 2, 3, 8, 9, 10, 11) +
                         SNAPSPACE_SHUFFLE(fours[0], fours[1], 4, 5, 6, 7, 12, 13, 14, 15)));
    }
    return;
  } else if constexpr (Width == 8) {
    Lanes<4> halves[Count];
    for (int i = 0; i < Count; ++i) {
      const auto v = packs[i].v;
      halves[i] =
          Lanes<4>(SNAPSPACE_SHUFFLE(v, v, 0, 1, 2, 3) + SNAPSPACE_SHUFFLE(v, v, 4, 5, 6, 7));
    }
    return lane_sums<Count>(halves, sums);
  } else if constexpr (Width == 4 && Count % 4 == 0) {
    for (int i = 0; i < Count; i += 4) {
      const auto a = packs[i].v, b = packs[i + 1].v, c = packs[i + 2].v, d = packs[i + 3].v;
      const auto ab = SNAPSPACE_SHUFFLE(a, b, 0, 4, 2, 6) + SNAPSPACE_SHUFFLE(a, b, 1, 5, 3, 7);
      const auto cd = SNAPSPACE_SHUFFLE(c, d, 0, 4, 2, 6) + SNAPSPACE_SHUFFLE(c, d, 1, 5, 3, 7);
      store(sums + i, Lanes<4>(SNAPSPACE_SHUFFLE(ab, cd, 0, 1, 4, 5) +
                               SNAPSPACE_SHUFFLE(ab, cd, 2, 3, 6, 7)));
    }
    return;
  }
#endif
  for (int i = 0; i < Count; ++i) {
    sums[i] = 0.0;
    for (int lane = 0; lane < Width; ++lane) sums[i] += packs[i][lane];
  }
}

}  // namespace snapspace
