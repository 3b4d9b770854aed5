#include "mesh/locality.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <vector>

#include "mesh/incidence.h"

namespace snapspace {

namespace {

/// Number of walks from end to end of a component. After two or three, the ends no longer move
/// apart.
constexpr int kWalks = 4;

/// Vertices of one component, breadth first from `root`. Every vertex that is found gets the mark.
std::vector<std::int32_t> breadth_first(std::int32_t root, const Incidence& incidence,
                                        const std::int32_t* corners, std::int32_t mark,
                                        std::vector<std::int32_t>& marks) {
  std::vector<std::int32_t> found{root};
  marks[root] = mark;
  for (std::size_t next = 0; next < found.size(); ++next)
    for (const std::int32_t tet : incidence.around(found[next]))
      for (int k = 0; k < 4; ++k) {
        const std::int32_t vertex = corners[4 * tet + k];
        if (marks[vertex] == mark) continue;
        marks[vertex] = mark;
        found.push_back(vertex);
      }
  return found;
}

}  // namespace

std::vector<std::int32_t> sweep_order(int vertex_count, const std::int32_t* corners,
                                      int tet_count) {
  const Incidence incidence(vertex_count, tet_count,
                            [&](int tet, int k) { return corners[4 * tet + k]; });
  std::vector<std::int32_t> order, marks(vertex_count, 0);
  std::int32_t mark = 0;
  for (std::int32_t vertex = 0; vertex < vertex_count; ++vertex) {
    if (marks[vertex] != 0) continue;
    std::vector<std::int32_t> component{vertex};
    for (int walk = 0; walk < kWalks; ++walk)
      component = breadth_first(component.back(), incidence, corners, ++mark, marks);
    order.insert(order.end(), component.begin(), component.end());
  }
  return order;
}

LocalMesh::LocalMesh(const double* old_vertices, int n, const std::int32_t* old_tets, int m)
    : order(sweep_order(n, old_tets, m)), places(n), vertices(3 * static_cast<std::size_t>(n)) {
  for (int i = 0; i < n; ++i) {
    places[order[i]] = i;
    std::copy_n(old_vertices + 3 * order[i], 3, vertices.begin() + 3 * i);
  }
  // Sort by the last vertex, then by the one before it: a pass over the tets then needs one vertex
  // after the other.
  struct Tet {
    std::array<std::int32_t, 4> key, corners;
    std::int32_t old;
  };
  std::vector<Tet> read(m), sorted(m);
  std::vector<std::int32_t> next(static_cast<std::size_t>(n) + 1, 0);
  for (int t = 0; t < m; ++t) {
    Tet& tet = read[t];
    for (int k = 0; k < 4; ++k) tet.corners[k] = places[old_tets[4 * t + k]];
    tet.key = tet.corners;
    tet.old = t;
    std::sort(tet.key.begin(), tet.key.end(), std::greater<>());
    ++next[tet.key[0] + 1];
  }
  std::partial_sum(next.begin(), next.end(), next.begin());
  for (const Tet& tet : read) sorted[next[tet.key[0]]++] = tet;
  // next[v] is now the end of the tets whose last vertex is v
  for (int v = 0, begin = 0; v < n; begin = next[v++])
    std::stable_sort(sorted.begin() + begin, sorted.begin() + next[v],
                     [](const Tet& a, const Tet& b) { return a.key < b.key; });
  tets.reserve(4 * static_cast<std::size_t>(m));
  tet_order.reserve(m);
  for (const Tet& tet : sorted) {
    tets.insert(tets.end(), tet.corners.begin(), tet.corners.end());
    tet_order.push_back(tet.old);
  }
}

}  // namespace snapspace
