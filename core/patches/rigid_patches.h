#pragma once
#include <cstdint>
#include <vector>

namespace snapspace {

/// Overlapping patches of a surface, with hat functions that sum to one at every vertex. Their
/// rigid motions, each times its hat, are the coarse space of a two-level preconditioner [rigid
/// motions of subdomains: Mandel 1993; partitions of unity: Sarkis 2003]: bending by smooth
/// rotations, which costs an elastic surface next to nothing, and which a scalar matrix mistakes
/// for stretching.
class RigidPatches {
 public:
  /// Motions of a patch: translations along x, y and z, and rotations about them.
  static constexpr int kMotions = 6;
  /// Most patches: the coarse matrix is dense. Of the Centaur 30, 60 and 100 patches leave 34, 29
  /// and 27 evaluations of a sample.
  static constexpr int kMostPatches = 64;

  /// @param shapes     count x n x 3; patches are as large as on average in all of them
  /// @param triangles  m x 4, whose first three entries are the corners
  RigidPatches(const double* shapes, int count, int vertex_count, const std::int32_t* triangles,
               int triangle_count);

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

  /// Positions in the first shape, 3n.
  [[nodiscard]] const std::vector<double>& positions() const { return positions_; }

 private:
  int count_ = 0;
  std::vector<std::int32_t> first_;
  std::vector<Place> places_;
  std::vector<double> positions_;
};

}  // namespace snapspace
