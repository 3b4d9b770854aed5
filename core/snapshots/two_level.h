#pragma once
#include "snapshots/coarse_space.h"
#include "snapshots/lane_objectives.h"

namespace snapspace {

/// Objectives with the seed A^{-1} + V B V^T of a two-level additive method (Dryja & Widlund 1990):
/// the scalar factor A for local deformations, and the inverse Hessian B of each sample on a
/// subspace for the soft and smooth ones, which A mistakes for stiff. The input of a sample is that
/// of `objectives` (`input_size` numbers) followed by B (d x d), symmetric and positive definite.
/// The objectives refer to the coarse space.
[[nodiscard]] LaneObjectives on_two_levels(LaneObjectives objectives, int input_size,
                                           const CoarseSpace& coarse);

}  // namespace snapspace
