#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "polish/coarse_space.h"
#include "snapshots/lane_objectives.h"

namespace snapspace {

/// The lowest shape that a solve has evaluated so far: the result of a cancelled solve.
struct LowestShape {
  std::vector<double> shape;  ///< empty before the first finite value
  double value = std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

/// Objectives of one sample, in lane 0, with the seed A^{-1} + U B U^T of a two-level additive
/// method (Dryja & Widlund 1990): the scalar factor A for local deformations, and the inverse
/// Hessian B on a subspace for the soft and smooth ones, which A mistakes for stiff. The objectives
/// refer to the arguments.
[[nodiscard]] LaneObjectives on_two_levels(LaneObjectives objectives, const CoarseSpace& coarse,
                                           const Eigen::MatrixXf& inverse, LowestShape& lowest);

}  // namespace snapspace
