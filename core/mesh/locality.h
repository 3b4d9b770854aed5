#pragma once
#include <cstdint>
#include <vector>

namespace snapspace {

/// Vertices breadth first from one end of every component to the other (Cuthill & McKee 1969; ends
/// as George & Liu 1979 find them). Returns the old index of every new one.
///
/// Vertices of a tet are then near each other in memory: with one sample per lane a vertex fills up
/// to three cache lines, and in a file's order an element would mostly wait for them. And a pass
/// over the tets leaves vertices for good soon after it has come to them (mesh/sweep.h).
///
/// @param corners  4 vertices per tet
[[nodiscard]] std::vector<std::int32_t> sweep_order(int vertex_count, const std::int32_t* corners,
                                                    int tet_count);

/// A mesh renumbered by sweep_order, its tets sorted by their last vertices.
struct LocalMesh {
  std::vector<std::int32_t> order;      ///< old index of every new one
  std::vector<std::int32_t> places;     ///< new index of every old one
  std::vector<double> vertices;         ///< n x 3
  std::vector<std::int32_t> tets;       ///< m x 4; corners keep their order, volumes their sign
  std::vector<std::int32_t> tet_order;  ///< old index of every new tet

  LocalMesh(const double* vertices, int vertex_count, const std::int32_t* tets, int tet_count);
};

}  // namespace snapspace
