#pragma once
#include <limits>
#include <vector>

#include "snapshots/lane_objectives.h"

namespace snapspace {

/// The lowest shape that a solve has evaluated so far: the result of a cancelled solve.
struct LowestShape {
  std::vector<double> shape;  ///< empty before the first finite value
  double value = std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

/// Objectives that keep the lowest shape of the sample in lane 0. They refer to it.
[[nodiscard]] LaneObjectives watched(LaneObjectives objectives, LowestShape& lowest);

}  // namespace snapspace
