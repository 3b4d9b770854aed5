#include "mesh/star_hats.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace snapspace {

namespace {

/// Reach of a hat in radii: hats of neighbouring stars overlap at their centers' distance.
constexpr double kSupport = 2.0;

/// Distances are whole numbers, with this many units to the radius. So rounding decides nothing: a
/// mesh has the same stars in all frames and units and on all processors.
constexpr std::int64_t kRadius = 1 << 20;
constexpr std::int64_t kReach = static_cast<std::int64_t>(kSupport * kRadius);
constexpr std::int64_t kFar = std::numeric_limits<std::int64_t>::max();

/// The edges of a mesh, with lengths relative to a radius.
class Distances {
 public:
  Distances(const EdgeGraph& edges, double radius)
      : first_(edges.first), ends_(edges.ends), distances_(edges.vertices(), kFar) {
    lengths_.reserve(edges.lengths.size());
    for (const double length : edges.lengths)  // no shorter than one, and so long that sums fit
      lengths_.push_back(std::clamp<std::int64_t>(
          std::llround(std::min(length / radius, 2.0 * kSupport) * kRadius), 1, 2 * kReach));
  }

  /// Vertices less than kReach from a vertex along edges (Dijkstra 1959), and their distances.
  const std::vector<std::pair<std::int32_t, std::int64_t>>& around(std::int32_t center) {
    using Place = std::pair<std::int64_t, std::int32_t>;
    std::priority_queue<Place, std::vector<Place>, std::greater<>> next;
    found_.clear();
    distances_[center] = 0;
    next.emplace(0, center);
    while (!next.empty()) {
      const auto [distance, vertex] = next.top();
      next.pop();
      if (distance > distances_[vertex]) continue;  // was reached by a shorter path
      found_.emplace_back(vertex, distance);
      for (int e = first_[vertex]; e < first_[vertex + 1]; ++e) {
        const std::int64_t farther = distance + lengths_[e];
        if (farther >= kReach || farther >= distances_[ends_[e]]) continue;
        distances_[ends_[e]] = farther;
        next.emplace(farther, ends_[e]);
      }
    }
    for (const auto& [vertex, distance] : found_) distances_[vertex] = kFar;
    return found_;
  }

 private:
  const std::vector<std::int32_t>&first_, &ends_;  // of the edges
  std::vector<std::int64_t> lengths_, distances_;  // all distances are kFar between calls
  std::vector<std::pair<std::int32_t, std::int64_t>> found_;
};

}  // namespace

StarHats star_hats(const EdgeGraph& edges, double radius) {
  const int vertex_count = edges.vertices();
  Distances distances(edges, radius);
  StarHats hats;
  hats.first.push_back(0);
  std::vector<bool> covered(vertex_count, false);
  std::vector<double> sums(vertex_count, 0.0);
  for (std::int32_t center = 0; center < vertex_count; ++center) {
    if (covered[center]) continue;
    covered[center] = true;
    auto reached = distances.around(center);
    std::sort(reached.begin() + 1, reached.end());  // the center is the first one
    for (const auto& [vertex, distance] : reached) {
      if (distance < kRadius) covered[vertex] = true;
      const double left = 1.0 - static_cast<double>(distance) / static_cast<double>(kReach);
      hats.vertices.push_back(vertex);
      hats.weights.push_back(left * left);
      sums[vertex] += left * left;
    }
    hats.first.push_back(static_cast<std::int32_t>(hats.vertices.size()));
  }
  for (std::size_t i = 0; i < hats.weights.size(); ++i) hats.weights[i] /= sums[hats.vertices[i]];
  return hats;
}

StarHats StarHats::renumbered(const std::vector<std::int32_t>& order) const {
  StarHats result;
  if (of_all_vertices()) return result;
  std::vector<std::int32_t> place(order.size()), stars(count());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<std::int32_t>(i);
  std::iota(stars.begin(), stars.end(), 0);
  std::sort(stars.begin(), stars.end(), [&](std::int32_t a, std::int32_t b) {
    return place[vertices[first[a]]] < place[vertices[first[b]]];
  });
  result.first.push_back(0);
  for (const std::int32_t star : stars) {
    std::vector<std::pair<std::int32_t, double>> row;
    for (int k = first[star]; k < first[star + 1]; ++k)
      row.emplace_back(place[vertices[k]], weights[k]);
    std::sort(row.begin() + 1, row.end());
    for (const auto& [vertex, weight] : row) {
      result.vertices.push_back(vertex);
      result.weights.push_back(weight);
    }
    result.first.push_back(static_cast<std::int32_t>(result.vertices.size()));
  }
  return result;
}

}  // namespace snapspace
