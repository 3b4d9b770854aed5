#pragma once
#include <cstdint>
#include <vector>

#include "mesh/edge_graph.h"

namespace snapspace {

/// Overlapping patches of a surface or a solid, with hat functions that sum to one at every vertex.
/// Their rigid motions, each times its hat, are the coarse space of a two-level preconditioner
/// [rigid motions of subdomains: Mandel 1993; partitions of unity: Sarkis 2003]: they bend the body
/// by smooth rotations, which cost almost no elastic energy but which a scalar matrix mistakes for
/// stretching.
class RigidPatches {
 public:
  /// Motions of a patch: translations along x, y and z, and rotations about them.
  static constexpr int kMotions = 6;

  /// @param shape  3n
  /// @param edges  with their mean lengths in all shapes, so that patches have their mean size
  /// @param most   maximum number of patches, limited because the coarse matrix is dense
  RigidPatches(const double* shape, const EdgeGraph& edges, int most);

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] int dimension() const { return kMotions * count_; }
  [[nodiscard]] int vertices() const { return static_cast<int>(first_.size()) - 1; }

  /// A patch at a vertex, and the value of its hat there.
  struct Place {
    std::int32_t patch;
    float hat;
  };
  [[nodiscard]] const Place* begin(int vertex) const { return places_.data() + first_[vertex]; }
  [[nodiscard]] const Place* end(int vertex) const { return places_.data() + first_[vertex + 1]; }

  /// Positions in the shape, 3n.
  [[nodiscard]] const std::vector<double>& positions() const { return positions_; }

 private:
  int count_ = 0;
  std::vector<std::int32_t> first_;
  std::vector<Place> places_;
  std::vector<double> positions_;
};

}  // namespace snapspace
