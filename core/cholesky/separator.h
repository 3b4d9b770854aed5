#pragma once
#include <cstdint>
#include <vector>

namespace snapspace {

/// An undirected graph with weights, neighbours of v in [first[v], first[v + 1]).
struct WeightedGraph {
  std::vector<std::int32_t> first{0}, neighbours, edge_weights, weights;

  [[nodiscard]] std::int32_t size() const { return static_cast<std::int32_t>(weights.size()); }
};

enum class Side : std::int8_t { left, right, separator };

/// Splits a graph into two sides of like weight that share no edge, and a light separator between
/// them: multilevel, with a refinement of the separator at every level [Hendrickson & Rothberg
/// 1998].
[[nodiscard]] std::vector<Side> find_separator(const WeightedGraph& graph);

}  // namespace snapspace
