#include "patches/rigid_patches.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "mesh/star_hats.h"

namespace snapspace {

namespace {

/// With fewer patches than this share of the maximum, another radius is tried.
constexpr double kFew = 0.6;
constexpr int kMaxTries = 6;
/// The hats of stars overlap widely. Hats below this share of the largest one at a vertex are cut
/// off there. This leaves two hats of eight, and solves take no more evaluations.
constexpr float kNarrower = 0.5f;

/// Root of the mean squared distance of the vertices from their mean.
double extent(const double* shape, int vertex_count) {
  double mean[3] = {}, square = 0.0;
  for (int i = 0; i < vertex_count; ++i)
    for (int r = 0; r < 3; ++r) mean[r] += shape[3 * static_cast<std::size_t>(i) + r];
  for (double& coordinate : mean) coordinate /= vertex_count;
  for (int i = 0; i < vertex_count; ++i)
    for (int r = 0; r < 3; ++r) {
      const double offset = shape[3 * static_cast<std::size_t>(i) + r] - mean[r];
      square += offset * offset;
    }
  return std::sqrt(square / vertex_count);
}

/// The hats of nearly `most` patches. The number of patches falls with the radius: along limbs in
/// inverse proportion, on sheets faster.
StarHats hats_of(const double* shape, const EdgeGraph& edges, int most) {
  double radius = 0.3 * extent(shape, edges.vertices());
  StarHats best;
  for (int i = 0; i < kMaxTries; ++i) {
    StarHats hats = star_hats(edges, radius);
    const double share = static_cast<double>(hats.count()) / most;
    if (share <= 1.0 && (best.of_all_vertices() || hats.count() > best.count()))
      best = std::move(hats);
    if (share >= kFew && share <= 1.0) break;
    radius *= std::clamp(std::pow(share / 0.85, 0.7), 0.5, 4.0);
  }
  return best;
}

}  // namespace

RigidPatches::RigidPatches(const double* shape, const EdgeGraph& edges, int most)
    : first_(static_cast<std::size_t>(edges.vertices()) + 1, 0),
      positions_(shape, shape + 3 * static_cast<std::size_t>(edges.vertices())) {
  const int vertex_count = edges.vertices();
  const StarHats hats = hats_of(shape, edges, most);
  if (hats.of_all_vertices()) return;  // no patches
  count_ = hats.count();
  std::vector<float> largest(vertex_count, 0.0f), sums(vertex_count, 0.0f);
  for (std::size_t k = 0; k < hats.vertices.size(); ++k) {
    float& most = largest[hats.vertices[k]];
    most = std::max(most, static_cast<float>(hats.weights[k]));
  }
  const auto narrowed = [&](std::size_t k) {
    return static_cast<float>(hats.weights[k]) - kNarrower * largest[hats.vertices[k]];
  };
  for (std::size_t k = 0; k < hats.vertices.size(); ++k) {
    if (narrowed(k) <= 0.0f) continue;
    ++first_[hats.vertices[k] + 1];
    sums[hats.vertices[k]] += narrowed(k);
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  places_.resize(first_.back());
  std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
  for (std::int32_t patch = 0; patch < count_; ++patch)
    for (int k = hats.first[patch]; k < hats.first[patch + 1]; ++k) {
      const std::int32_t vertex = hats.vertices[k];
      if (narrowed(k) > 0.0f) places_[next[vertex]++] = {patch, narrowed(k) / sums[vertex]};
    }
}

}  // namespace snapspace
