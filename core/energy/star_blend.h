#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "energy/vertex_stars.h"
#include "memory/streamed_vector.h"

namespace snapspace {

/// The weighted sum of the energies of several poses of one surface that is as rigid as possible.
///
/// With W = R - I and the affine map F of a star, L at rest, its energy is weight |G_t|^2 summed
/// over its triangles, and its weight times |W L|^2 - 2 (W L) . (F - L). The first parts of all
/// stars are the Dirichlet energy, so that triangles are not visited. All numbers of a star lie
/// together, and depend on the displacements from pose 0 only through the edges from its vertex.
/// That takes three fifths of the time of single energies, and loses digits where displacements are
/// large. A pose shares its corners with all others.
class StarBlend {
 public:
  /// @param poses  the stars of each pose, of the same triangles
  /// @param offsets  of each pose: pose 0 minus it, 3n
  StarBlend(const std::vector<const VertexStars*>& poses,
            const std::vector<std::vector<double>>& offsets);

  /// Energy of the stars from `begin` to before `end` at displacements u from pose 0, for weights
  /// of the poses; adds its gradient to `gradient` (3n). For packs of double precision.
  template <class Real>
  [[nodiscard]] Sum<Real> add_value_and_gradient(const Real* weights, int begin, int end,
                                                 const Real* u, Real* gradient) const;

 private:
  template <class Real>
  class StarSum;
  /// Numbers of a star in a pose: L and the F of pose 0, row by row; pull and offset of its vertex,
  /// and its weight. After them four per corner besides the vertex: its share of F, and its pull.
  enum Places { kFrame = 0, kMap = 9, kPull = 18, kOffset = 21, kWeight = 24, kHeader = 25 };
  static constexpr int kPerCorner = 4;

  /// Numbers of a star in a pose, and where they begin.
  [[nodiscard]] std::size_t numbers_of(int star) const {
    return kHeader + kPerCorner * static_cast<std::size_t>(ring(star));
  }
  [[nodiscard]] const double* begin_of(int star) const {
    const auto before = static_cast<std::size_t>(first_corner_[star] - star);
    return numbers_.data() +
           poses_ * (kHeader * static_cast<std::size_t>(star) + kPerCorner * before);
  }
  /// Number of corners besides the vertex.
  [[nodiscard]] int ring(int star) const {
    return first_corner_[star + 1] - first_corner_[star] - 1;
  }

  std::size_t poses_;
  std::vector<std::int32_t> first_corner_, corners_;  // as those of VertexStars
  StreamedVector<double> numbers_;                    // star by star, pose by pose
};

}  // namespace snapspace
