#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace snapspace {

/// An undirected graph without loops, with a weight per vertex and per edge. Each edge is stored at
/// both of its ends: those of vertex v are [first[v], first[v + 1]).
struct WeightedGraph {
  std::vector<std::int32_t> first{0}, neighbours, edge_weights, weights;

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(weights.size()); }
  [[nodiscard]] std::span<const std::int32_t> around(std::int32_t v) const {
    return {neighbours.data() + first[v], neighbours.data() + first[v + 1]};
  }
};

/// Where a vertex is when a separator splits the graph.
enum class Side : std::int8_t { left, right, separator };

}  // namespace snapspace
