#include "mesh/edge_graph.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace snapspace {

EdgeGraph::EdgeGraph(const double* shapes, int count, int vertex_count, const std::int32_t* cells,
                     int cell_count, int corners)
    : first(static_cast<std::size_t>(vertex_count) + 1, 0) {
  std::vector<std::pair<std::int32_t, std::int32_t>> edges;
  edges.reserve(static_cast<std::size_t>(cell_count) * corners * (corners - 1));
  for (int i = 0; i < cell_count; ++i, cells += corners)
    for (int a = 0; a < corners; ++a)
      for (int b = 0; b < corners; ++b)
        if (a != b) edges.emplace_back(cells[a], cells[b]);
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& [from, to] : edges) {
    ++first[from + 1];
    ends.push_back(to);
    double length = 0.0;
    for (int k = 0; k < count; ++k) {
      const double* shape = shapes + 3 * static_cast<std::size_t>(k) * vertex_count;
      double square = 0.0;
      for (int r = 0; r < 3; ++r) {
        const double side = shape[3 * static_cast<std::size_t>(to) + r] -
                            shape[3 * static_cast<std::size_t>(from) + r];
        square += side * side;
      }
      length += std::sqrt(square) / count;
    }
    lengths.push_back(length);
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
}

}  // namespace snapspace
