#pragma once
#include "snapshots/lane_objectives.h"
#include "snapshots/soft_modes.h"

namespace snapspace {

/// Objectives with the seed A^{-1} + V B V^T in place of A^{-1}, their scalar factor: the factor
/// for what is local, and a few modes for what is soft and smooth. They refer to the modes.
[[nodiscard]] LaneObjectives softened(LaneObjectives objectives, const SoftModes& modes);

}  // namespace snapspace
