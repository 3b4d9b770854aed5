#pragma once
#include "snapshots/lane_objectives.h"
#include "snapshots/sample_system.h"

namespace snapspace {

/// Objectives of a system with patches, whose seed is A^{-1} + V B V^T: a two-level additive method
/// (Dryja & Widlund 1990) with the scalar factor A for local deformations, and the inverse Hessian
/// B of each sample for rigid motions V of the patches, see RigidPatches. V and B belong to a shape
/// of the sample. The objectives refer to the system.
[[nodiscard]] LaneObjectives on_patches(const SampleSystem& system);

}  // namespace snapspace
