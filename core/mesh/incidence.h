#pragma once
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

namespace snapspace {

/// The tets around each vertex, in ascending order. A tet with a repeated corner, which stands for
/// a triangle (element/rest_shell.h), is there once.
class Incidence {
 public:
  /// @param corner  corner(tet, k) is the k-th vertex of a tet, k from 0 to 3
  template <class Corner>
  Incidence(int vertex_count, int tet_count, Corner&& corner)
      : first_(static_cast<std::size_t>(vertex_count) + 1, 0),
        tets_(4 * static_cast<std::size_t>(tet_count)) {
    const auto corners = [&](int tet) { return corner(tet, 2) == corner(tet, 3) ? 3 : 4; };
    for (int tet = 0; tet < tet_count; ++tet)
      for (int k = 0; k < corners(tet); ++k) ++first_[corner(tet, k) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<std::int32_t> next(first_.begin(), first_.end() - 1);
    for (int tet = 0; tet < tet_count; ++tet)
      for (int k = 0; k < corners(tet); ++k) tets_[next[corner(tet, k)]++] = tet;
  }

  [[nodiscard]] std::span<const std::int32_t> around(std::int32_t vertex) const {
    return std::span(tets_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
  }

 private:
  std::vector<std::int32_t> first_, tets_;  // v has tets_[first_[v]] to before tets_[first_[v + 1]]
};

}  // namespace snapspace
