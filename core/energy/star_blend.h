#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "energy/vertex_stars.h"
#include "memory/streamed_vector.h"

namespace snapspace {

/// The weighted sum of the energies of several poses of one as-rigid-as-possible surface.
///
/// With W = R - I and the affine map F of a star, L at rest, its energy is the sum of weight_t
/// |G_t|^2 over its triangles, plus its weight times |W L|^2 - 2 (W L) . (F - L). The first parts
/// of all stars add up to the Dirichlet energy, so triangles are not visited. All numbers of a
/// vertex are stored together, and so are those of a star. Displacements from pose 0 enter only
/// through the edges from the vertex, or from the center. This takes three fifths of the time of
/// evaluating the energies one by one, but loses digits where displacements are large. All poses
/// have the same stars.
class StarBlend {
 public:
  /// @param poses  the stars of each pose, of the same triangles and hats
  /// @param offsets  for each pose, pose 0 minus that pose (3n)
  StarBlend(const std::vector<const VertexStars*>& poses,
            const std::vector<std::vector<double>>& offsets);

  /// Energy of the vertices from `begin` to before `end`, and of the stars that are centered there,
  /// at displacements u from pose 0, for weights of the poses; adds its gradient to `gradient`
  /// (3n). For packs of double precision.
  template <class Real>
  [[nodiscard]] Sum<Real> add_value_and_gradient(const Real* weights, int begin, int end,
                                                 const Real* u, Real* gradient) const;

  /// The first star that is centered at a vertex, or after it.
  [[nodiscard]] int first_star(int vertex) const;

 private:
  template <class Real>
  class StarSum;
  /// Numbers of a star in a pose: L and the F of pose 0, row by row, and its weight. After those of
  /// all poses come the shares of F of the corners besides the center, three numbers each: tile by
  /// tile, pose by pose.
  enum StarPlaces { kFrame = 0, kMap = 9, kWeight = 18, kHeader = 19 };
  static constexpr int kPerCorner = 3;
  /// Corners of a tile: those of four lanes take 12 kB of the fastest memory.
  static constexpr int kTile = 128;
  /// Numbers of a vertex in a pose: its pull in pose 0, and its offset. After them the coupling of
  /// every neighbour.
  enum VertexPlaces { kPull = 0, kOffset = 3, kCouplings = 6 };

  void append_vertex(int vertex, const VertexStars& pose, const double* offset);
  void append_star(int star, const std::vector<const VertexStars*>& poses,
                   const std::vector<std::vector<double>>& offsets);

  /// The Dirichlet energy of some vertices.
  template <class Real>
  [[nodiscard]] Real add_vertices(const Real* weights, const std::vector<int>& used, int begin,
                                  int end, const Real* u, Real* gradient) const;

  [[nodiscard]] const double* begin_of_star(int star) const {
    const auto before = static_cast<std::size_t>(first_corner_[star] - star);
    return star_numbers_.data() +
           poses_ * (kHeader * static_cast<std::size_t>(star) + kPerCorner * before);
  }
  /// Numbers of a vertex in a pose.
  [[nodiscard]] std::size_t numbers_of_vertex(int vertex) const {
    return kCouplings +
           static_cast<std::size_t>(first_neighbour_[vertex + 1] - first_neighbour_[vertex]);
  }
  [[nodiscard]] const double* begin_of_vertex(int vertex) const {
    return vertex_numbers_.data() +
           poses_ * (kCouplings * static_cast<std::size_t>(vertex) + first_neighbour_[vertex]);
  }
  /// Number of corners besides the center.
  [[nodiscard]] int ring(int star) const {
    return first_corner_[star + 1] - first_corner_[star] - 1;
  }

  std::size_t poses_;
  std::vector<std::int32_t> first_corner_, corners_;        // as those of VertexStars
  std::vector<std::int32_t> first_neighbour_, neighbours_;  // the same
  std::vector<std::int32_t> centers_;                       // centers of the stars, ascending
  StreamedVector<double> vertex_numbers_, star_numbers_;    // one by one
};

}  // namespace snapspace
