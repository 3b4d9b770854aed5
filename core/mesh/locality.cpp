#include "mesh/locality.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <utility>

namespace snapspace {

namespace {

/// Walks from end to end of a component. After two or three the ends are as far apart as they get.
constexpr int kWalks = 4;

/// Tets around every vertex: those of v are [first[v], first[v + 1]) of `tets`.
struct Incidence {
  std::vector<std::int32_t> first, tets;

  Incidence(int vertex_count, const std::int32_t* corners, int tet_count)
      : first(vertex_count + 1, 0), tets(4 * static_cast<std::size_t>(tet_count)) {
    for (std::size_t i = 0; i < tets.size(); ++i) ++first[corners[i] + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::int32_t> next(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < tets.size(); ++i)
      tets[next[corners[i]]++] = static_cast<std::int32_t>(i / 4);
  }
};

/// Vertices of one component, breadth first from `root`. Those that are seen have the mark.
std::vector<std::int32_t> breadth_first(std::int32_t root, const Incidence& around,
                                        const std::int32_t* corners, std::int32_t mark,
                                        std::vector<std::int32_t>& marks) {
  std::vector<std::int32_t> found{root};
  marks[root] = mark;
  for (std::size_t next = 0; next < found.size(); ++next)
    for (std::int32_t k = around.first[found[next]]; k < around.first[found[next] + 1]; ++k)
      for (int corner = 0; corner < 4; ++corner) {
        const std::int32_t vertex = corners[4 * around.tets[k] + corner];
        if (marks[vertex] == mark) continue;
        marks[vertex] = mark;
        found.push_back(vertex);
      }
  return found;
}

}  // namespace

std::vector<std::int32_t> sweep_order(int vertex_count, const std::int32_t* corners,
                                      int tet_count) {
  const Incidence around(vertex_count, corners, tet_count);
  std::vector<std::int32_t> order, marks(vertex_count, 0);
  std::int32_t mark = 0;
  for (std::int32_t vertex = 0; vertex < vertex_count; ++vertex) {
    if (marks[vertex] != 0) continue;
    std::vector<std::int32_t> component{vertex};
    for (int walk = 0; walk < kWalks; ++walk)
      component = breadth_first(component.back(), around, corners, ++mark, marks);
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
  // By the last vertex, then the one before: a pass over the tets then needs one vertex after the
  // other.
  using Corners = std::array<std::int32_t, 4>;
  std::vector<std::pair<Corners, Corners>> sorted(m);
  for (int t = 0; t < m; ++t) {
    auto& [key, tet] = sorted[t];
    for (int k = 0; k < 4; ++k) tet[k] = places[old_tets[4 * t + k]];
    key = tet;
    std::sort(key.begin(), key.end(), std::greater<>());
  }
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  tets.reserve(4 * static_cast<std::size_t>(m));
  for (const auto& [key, tet] : sorted) tets.insert(tets.end(), tet.begin(), tet.end());
}

}  // namespace snapspace
