#pragma once
#include <cstdint>
#include <vector>

#include "mesh/edge_graph.h"

namespace snapspace {

/// Weights of the vertices in the stars of a surface: hat functions that sum to one at every
/// vertex. A star is centered at a vertex, which is the first one of its row. Without rows every
/// vertex has a star, whose hat is one there and zero at all others.
struct StarHats {
  std::vector<std::int32_t> first;     ///< rows of star i: first[i] to before first[i + 1]
  std::vector<std::int32_t> vertices;  ///< with a weight above zero; the center, then ascending
  std::vector<double> weights;

  [[nodiscard]] bool of_all_vertices() const { return first.empty(); }
  [[nodiscard]] int count() const { return static_cast<int>(first.size()) - 1; }

  /// The same in another numbering of the vertices: entry i is vertex order[i]. Stars are in
  /// ascending order of their centers.
  [[nodiscard]] StarHats renumbered(const std::vector<std::int32_t>& order) const;
};

/// Stars whose centers are at least `radius` apart along the edges, and less than that from every
/// vertex. A hat falls from its center as (1 - distance / (support * radius))^2, divided by the sum
/// of all hats at the vertex. Where edges are longer than that, it is a hat of one ring.
[[nodiscard]] StarHats star_hats(const EdgeGraph& edges, double radius);

}  // namespace snapspace
