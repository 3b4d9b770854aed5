#pragma once
#include <cstdint>
#include <vector>

namespace snapspace {

/// Vertices in the order of a space-filling (Morton) curve through their bounding box, so that
/// vertices of a tet are near each other in memory: with one sample per lane a vertex fills up to
/// three cache lines, and in a file's order an element would mostly wait for them. Returns the old
/// index of every new one.
///
/// @param vertices  count x 3, finite; count >= 1
[[nodiscard]] std::vector<std::int32_t> morton_order(const double* vertices, int count);

/// A mesh renumbered by morton_order, its tets sorted by their last vertices along the curve.
struct LocalMesh {
  std::vector<std::int32_t> order;   ///< old index of every new one
  std::vector<std::int32_t> places;  ///< new index of every old one
  std::vector<double> vertices;      ///< n x 3
  std::vector<std::int32_t> tets;    ///< m x 4; corners keep their order, volumes their sign

  LocalMesh(const double* vertices, int vertex_count, const std::int32_t* tets, int tet_count);
};

}  // namespace snapspace
