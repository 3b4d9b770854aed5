#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "energy/elastic_energy.h"

namespace snapspace {

/// Sum of weights_k * E_k, with pose k of one mesh as the rest shape of E_k (paper, sec. 3.3), as a
/// function of displacements u from pose 0.
///
/// All poses have the same tets. Let F be a tet's deformation gradient against pose 0, and A_k the
/// constant map of its edges in pose k onto those in pose 0. Against pose k the deformation
/// gradient is F A_k: a pose needs neither the vertices nor F, and its stress P_k adds P_k A_k^T to
/// the one against pose 0. That holds for every density.
class BlendedEnergy {
 public:
  /// @param poses  count x n x 3, row-major   @param tets  m x 4, none without volume in any pose
  BlendedEnergy(const double* poses, int count, int vertex_count, const std::int32_t* tets,
                int tet_count, const MaterialField& material);

  [[nodiscard]] int poses() const { return static_cast<int>(energies_.size()); }
  [[nodiscard]] int size() const { return 3 * energies_[0].rest.vertex_count; }
  [[nodiscard]] int tets() const { return energies_[0].tets(); }
  /// E_k, which takes displacements from pose k.
  [[nodiscard]] const ElasticEnergy& energy(int pose) const { return energies_[pose]; }
  /// Pose 0 - this pose, 3n: what is added to u for E_k.
  [[nodiscard]] const std::vector<double>& offset(int pose) const { return offsets_[pose]; }

  /// Value at u of the tets from `begin` to before `end`; `gradient` (3n) is overwritten. The
  /// vertices are read and written once for all poses. @param weights  one per pose
  template <class Real>
  [[nodiscard]] Sum<Real> value_and_gradient(const Real* weights, const Real* u, Real* gradient,
                                             int begin, int end) const;

 private:
  struct PoseElement {
    double map[3][3];            // A_k - I
    double moduli[kMostModuli];  // times volume
  };

  [[nodiscard]] PoseElement element(int tet, int pose) const;

  std::vector<ElasticEnergy> energies_;
  std::vector<std::vector<double>> offsets_;
  std::vector<PoseElement> elements_;  // tet by tet, pose by pose
};

#define SNAPSPACE_DECLARED(Real)                                                               \
  extern template Sum<Real> BlendedEnergy::value_and_gradient(const Real*, const Real*, Real*, \
                                                              int, int) const;
SNAPSPACE_PACKS(SNAPSPACE_DECLARED)
#undef SNAPSPACE_DECLARED

}  // namespace snapspace
