#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "energy/elastic_energy.h"
#include "energy/star_blend.h"

namespace snapspace {

/// Sum of weights_k * E_k, with pose k of one mesh as the rest shape of E_k (paper, sec. 3.3), as a
/// function of displacements u from pose 0.
/// All poses have the same tets. The energy of a tet relative to pose k is that of F A_k, see
/// PoseBlend, so a pose needs neither its own vertices nor its own F.
/// As-rigid-as-possible surfaces have the stars of their vertices instead of tets, and every pose
/// has its own stars.
/// Samples differ in their weights. Evaluations read the weights in a form that is made once per
/// sample: the weights themselves or, if the density collapses, the numbers of all tets.
class BlendedEnergy {
 public:
  /// @param poses  count x n x 3, row-major   @param tets  m x 4, none without volume in any pose;
  ///               for a shell, its triangles and hinges
  /// @param material  for a shell, only its moduli are read, see shell_pose_materials
  BlendedEnergy(const double* poses, int count, int vertex_count, const std::int32_t* tets,
                int tet_count, const MaterialField& material);

  [[nodiscard]] int poses() const { return static_cast<int>(energies_.size()); }
  [[nodiscard]] int size() const { return 3 * energies_[0].rest.vertex_count; }
  /// Number of tets, or of vertices if there are stars.
  [[nodiscard]] int tets() const {
    return stars_ ? energies_[0].rest.vertex_count : energies_[0].tets();
  }
  /// E_k, which takes displacements from pose k.
  [[nodiscard]] const ElasticEnergy& energy(int pose) const { return energies_[pose]; }
  /// Pose 0 minus this pose, 3n: it is added to u for E_k.
  [[nodiscard]] const std::vector<double>& offset(int pose) const { return offsets_[pose]; }

  /// How many numbers represent the weights of a sample.
  [[nodiscard]] std::size_t blend_size() const;

  /// Sets a lane of `blend` (blend_size()) to a sample's weights (poses).
  template <class Real>
  void set_weights(int lane, const double* weights, Real* blend) const;

  /// Value at u of the tets from `begin` to before `end`; `gradient` (3n) is overwritten.
  template <class Real>
  [[nodiscard]] Sum<Real> value_and_gradient(const Real* blend, const Real* u, Real* gradient,
                                             int begin, int end) const;

  /// First Piola-Kirchhoff stresses of some tets relative to pose 0, times their volumes there (c x
  /// 9, row by row), and their energies (c), at u for these weights; not for stars.
  void tet_stresses(const std::vector<std::int32_t>& which, const double* weights, const double* u,
                    double* stresses, double* energies) const;

  /// Whether there are Hessians of single tets.
  [[nodiscard]] bool has_tet_hessians() const;
  /// The Hessian (9 x 9) of a tet's energy with respect to its displacement gradient relative to
  /// pose 0, at u for these weights; only if has_tet_hessians().
  void tet_hessian(int tet, const double* weights, const double* u, double H[9][9]) const;
  /// Whether a scalar matrix can be made of sums over the poses, see scalar_hessian.
  [[nodiscard]] bool has_scalar_hessians() const;
  /// What replaces that Hessian for each row of the displacement gradient: a semi-definite matrix D
  /// (3 x 3) that does not change if u rotates. With hat gradients b, b_j^T D b_k replaces the
  /// block of vertices j and k; only if has_scalar_hessians().
  void scalar_hessian(int tet, const double* weights, const double* u, double D[3][3]) const;

 private:
  /// Up to this many poses, the numbers of a tet are summed in every evaluation: the samples of a
  /// pack share the numbers of the poses, whereas each would have to read its own sums.
  static constexpr int kFewPoses = 8;

  [[nodiscard]] int kind() const { return energies_[0].material.view().kind; }
  /// Whether a sample keeps the sums of all tets.
  [[nodiscard]] bool keeps_sums() const;
  void fill_numbers(int tet, int pose, double* result) const;
  /// The numbers of a tet, summed over the poses with these weights.
  void sum_numbers(int tet, const double* weights, double* sums) const;
  /// Calls evaluate(density, sums of the tet's numbers, displacement gradient).
  template <class Evaluate>
  void with_sums(int tet, const double* weights, const double* u, Evaluate evaluate) const;
  template <class Real>
  [[nodiscard]] Sum<Real> add_stars(const Real* blend, const Real* u, Real* gradient, int begin,
                                    int end) const;
  /// @param blend  the weights, or the tet's own sums
  template <class Density, class Real>
  [[nodiscard]] Sum<Real> tet_value_and_stress(int tet, const Real* blend, const Real G[3][3],
                                               Real P[3][3]) const;

  std::vector<ElasticEnergy> energies_;
  std::vector<std::vector<double>> offsets_;
  std::vector<double> numbers_;  // tet by tet, pose by pose, see PoseBlend
  std::optional<StarBlend> stars_;
};

#define SNAPSPACE_DECLARED(Real)                                                               \
  extern template void BlendedEnergy::set_weights(int, const double*, Real*) const;            \
  extern template Sum<Real> BlendedEnergy::value_and_gradient(const Real*, const Real*, Real*, \
                                                              int, int) const;
SNAPSPACE_PACKS(SNAPSPACE_DECLARED)
#undef SNAPSPACE_DECLARED

}  // namespace snapspace
