#include "patches/tet_sample.h"

#include <algorithm>
#include <cstddef>

namespace snapspace {

namespace {

/// The patch whose hat is largest at a corner of the tet.
std::int32_t main_patch(const RigidPatches& patches, const RestTet& tet) {
  RigidPatches::Place best{0, -1.0f};
  for (const std::int32_t vertex : tet.vertices)
    for (const auto* place = patches.begin(vertex); place != patches.end(vertex); ++place)
      if (place->hat > best.hat) best = *place;
  return best.patch;
}

}  // namespace

/// Neighbours in space have indices near each other, so tets at regular intervals cover a patch.
TetSample::TetSample(const RigidPatches& patches, const RestShape& rest) {
  std::vector<std::vector<std::int32_t>> of_patches(patches.count());
  for (std::size_t t = 0; t < rest.tets.size(); ++t)
    of_patches[main_patch(patches, rest.tets[t])].push_back(static_cast<std::int32_t>(t));
  for (const std::vector<std::int32_t>& all : of_patches) {
    const std::size_t count = std::min<std::size_t>(kOfPatch, all.size());
    double volume = 0.0, chosen = 0.0;
    for (const std::int32_t t : all) volume += rest.tets[t].volume;
    for (std::size_t i = 0; i < count; ++i) {
      tets.push_back(all[(2 * i + 1) * all.size() / (2 * count)]);
      chosen += rest.tets[tets.back()].volume;
    }
    shares.resize(tets.size(), volume / chosen);
  }
}

}  // namespace snapspace
