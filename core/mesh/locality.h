#pragma once
#include <cstdint>
#include <vector>

namespace snapspace {

/// Orders vertices breadth first from one end of each component to the other (Cuthill & McKee 1969;
/// the ends are found as in George & Liu 1979). Returns the old index of each new vertex.
/// The vertices of a tet are then near each other in memory. With one sample per lane a vertex
/// fills up to three cache lines, and in a file's order an element would mostly wait for them. A
/// pass over the tets also finishes with each vertex soon after it first reaches it (mesh/sweep.h).
///
/// @param corners  4 vertices per tet
[[nodiscard]] std::vector<std::int32_t> sweep_order(int vertex_count, const std::int32_t* corners,
                                                    int tet_count);

/// A mesh renumbered by sweep_order, its tets sorted by their last vertices.
struct LocalMesh {
  std::vector<std::int32_t> order;      ///< old index of each new vertex
  std::vector<std::int32_t> places;     ///< new index of each old vertex
  std::vector<double> vertices;         ///< n x 3
  std::vector<std::int32_t> tets;       ///< m x 4; orders of corners and signs of volumes are kept
  std::vector<std::int32_t> tet_order;  ///< old index of each new tet

  LocalMesh(const double* vertices, int vertex_count, const std::int32_t* tets, int tet_count);
};

}  // namespace snapspace
