#pragma once
#include <cstdint>
#include <vector>

namespace snapspace {

/// The edges at each vertex of a mesh, in ascending order of their other ends.
struct EdgeGraph {
  std::vector<std::int32_t> first;  ///< edges of vertex i: first[i] to before first[i + 1]
  std::vector<std::int32_t> ends;
  std::vector<double> lengths;

  /// @param shapes  count x n x 3; the length of an edge is its mean in all of them
  /// @param cells   cell_count x corners, triangles or tets: all corners of a cell are connected
  EdgeGraph(const double* shapes, int count, int vertex_count, const std::int32_t* cells,
            int cell_count, int corners);

  [[nodiscard]] int vertices() const { return static_cast<int>(first.size()) - 1; }
};

}  // namespace snapspace
