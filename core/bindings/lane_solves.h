#pragma once
#include <cstddef>
#include <vector>

#include "bindings/arrays.h"
#include "simd/lanes.h"
#include "threads/flush_denormals.h"

namespace snapspace {

/// Solves for all right-hand sides (k, 3n) at once, k up to the width; Real is double or a pack.
/// @param solve  (3n Reals), in place
template <class Real, int Width, class Solve>
DoublesOut solved_in_lanes(std::size_t vertices, MatrixIn right_hand_sides, Solve solve) {
  const std::size_t count = right_hand_sides.shape(0), size = right_hand_sides.shape(1);
  require(size == 3 * vertices && count <= Width, "needs (k, 3n), and k no more than lanes");
  const FlushDenormals flush;
  std::vector<Real> packed(size, Real(0));
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < size; ++i)
      set_lane(packed[i], static_cast<int>(k), right_hand_sides(k, i));
  solve(packed.data());
  DoublesOut result = new_array<double>({count, size});
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < size; ++i) {
      if constexpr (Width == 1)
        result.data()[i] = packed[i];
      else
        result.data()[k * size + i] = packed[i][static_cast<int>(k)];
    }
  return result;
}

}  // namespace snapspace
