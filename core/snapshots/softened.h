#pragma once
#include "snapshots/lane_objectives.h"
#include "snapshots/soft_modes.h"

namespace snapspace {

/// Objectives with the seed A^{-1} + V B V^T instead of A^{-1}, their scalar factor: the factor for
/// local deformations, and a few modes for soft and smooth ones. They refer to the modes.
[[nodiscard]] LaneObjectives softened(LaneObjectives objectives, const SoftModes& modes);

}  // namespace snapspace
