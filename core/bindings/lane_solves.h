#pragma once
#include <cstddef>

#include "bindings/arrays.h"
#include "lanes/in_lanes.h"

namespace snapspace {

/// Solutions (k, 3n) for all right-hand sides (k, 3n) at once; k is at most the pack's width.
/// @param solve  function of (k, right-hand sides, solutions)
template <class Solve>
DoublesOut solved_in_lanes(std::size_t vertices, Packing packing, const MatrixIn& right_hand_sides,
                           Solve solve) {
  const std::size_t count = right_hand_sides.shape(0), size = right_hand_sides.shape(1);
  require(size == 3 * vertices && count <= static_cast<std::size_t>(samples_together(packing)),
          "needs (k, 3n) with k at most the number of lanes");
  DoublesOut result = new_array<double>({count, size});
  solve(count, right_hand_sides.data(), result.data());
  return result;
}

}  // namespace snapspace
