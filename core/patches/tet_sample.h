#pragma once
#include <cstdint>
#include <vector>

#include "mesh/rest_shape.h"
#include "patches/rigid_patches.h"

namespace snapspace {

/// A few tets of every patch. Each stands for a share of the patch's volume, so that sums over them
/// are estimates of sums over all tets.
struct TetSample {
  std::vector<std::int32_t> tets;
  std::vector<double> shares;  ///< how many times a tet counts

  /// Tets of a patch. With half as many, blends of ten Lions end four times as far from the
  /// minimum, because the seed misses thin limbs.
  static constexpr int kOfPatch = 64;

  TetSample(const RigidPatches& patches, const RestShape& rest);
};

}  // namespace snapspace
