#pragma once
#include <algorithm>
#include <cstdint>
#include <vector>

#include "energy/elastic_energy.h"

namespace snapspace {

/// Sum of weights_k * E_k, with pose k of one mesh as the rest shape of E_k (paper, sec. 3.3), as a
/// function of displacements u from pose 0.
///
/// All poses have the same tets. Let F be a tet's deformation gradient against pose 0, C = F^T F,
/// and A_k the constant map of its edges in pose k onto those in pose 0. Against pose k the
/// deformation gradient is F A_k, and the strain (A_k^T C A_k - I) / 2: a pose needs neither the
/// vertices nor F, and its stress S_k adds A_k S_k A_k^T to the one against pose 0.
class BlendedEnergy {
 public:
  /// @param poses  count x n x 3, row-major   @param tets  m x 4, none without volume in any pose
  BlendedEnergy(const double* poses, int count, int vertex_count, const std::int32_t* tets,
                int tet_count, StVK material)
      : material_(material) {
    const std::size_t size = 3 * static_cast<std::size_t>(vertex_count);
    for (int k = 0; k < count; ++k) {
      const double* pose = poses + k * size;
      energies_.push_back({RestShape(pose, vertex_count, tets, tet_count), material});
      std::vector<double>& offset = offsets_.emplace_back(poses, poses + size);
      for (std::size_t i = 0; i < size; ++i) offset[i] -= pose[i];
    }
    elements_.reserve(static_cast<std::size_t>(tet_count) * count);
    for (int t = 0; t < tet_count; ++t)
      for (int k = 0; k < count; ++k) elements_.push_back(element(t, k));
  }

  [[nodiscard]] int poses() const { return static_cast<int>(energies_.size()); }
  [[nodiscard]] int size() const { return 3 * energies_[0].rest.vertex_count; }
  /// E_k, which takes displacements from pose k.
  [[nodiscard]] const ElasticEnergy& energy(int pose) const { return energies_[pose]; }
  /// Pose 0 - this pose, 3n: what is added to u for E_k.
  [[nodiscard]] const std::vector<double>& offset(int pose) const { return offsets_[pose]; }

  [[nodiscard]] int tets() const { return static_cast<int>(energies_[0].rest.tets.size()); }

  /// Value at u of the tets from `begin` to before `end`; `gradient` (3n) is overwritten. The
  /// vertices are read and written once for all poses. @param weights  one per pose
  template <class Real>
  Sum<Real> value_and_gradient(const Real* weights, const Real* u, Real* gradient, int begin,
                               int end) const {
    std::fill_n(gradient, size(), Real(0.0));
    Sum<Real> energy(0.0);
    const PoseElement* pose = elements_.data() + static_cast<std::size_t>(begin) * poses();
    for (int t = begin; t < end; ++t) {
      const RestTet& tet = energies_[0].rest.tets[t];
      Real G[3][3], C[3][3], S[3][3], P[3][3], forces[3][3];
      displacement_gradient(tet, u, G);
      cauchy_green(G, C);
      set_zero(S);
      for (int k = 0; k < poses(); ++k, ++pose)
        energy += widened(add_pose(*pose, weights[k] * Real(pose->volume), C, S));
      S[1][0] = S[0][1];
      S[2][0] = S[0][2];
      S[2][1] = S[1][2];
      first_stress(G, S, P);
      vertex_forces(tet, P, forces);
      scatter_forces(tet, forces, gradient);
    }
    return energy;
  }

 private:
  struct PoseElement {
    double map[3][3];  // A_k
    double volume;
  };

  template <class Real>
  static void set_zero(Real M[3][3]) {
    for (int i = 0; i < 9; ++i) M[i / 3][i % 3] = Real(0.0);
  }

  /// C = I + G + G^T + G^T G, whole.
  template <class Real>
  static void cauchy_green(const Real G[3][3], Real C[3][3]) {
    strain(G, C);
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c) {
        const Real twice = C[r][c] + C[r][c];
        C[r][c] = C[c][r] = r == c ? twice + Real(1.0) : twice;
      }
  }

  /// Adds weighted A S A^T to the upper triangle of `total`; returns the weighted density.
  template <class Real>
  Real add_pose(const PoseElement& pose, Real weighted_volume, const Real C[3][3],
                Real total[3][3]) const {
    const double (*A)[3] = pose.map;
    Real CA[3][3], E[3][3], S[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        CA[r][c] = C[r][0] * A[0][c] + C[r][1] * A[1][c] + C[r][2] * A[2][c];
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c) {
        const Real image = CA[0][c] * A[0][r] + CA[1][c] * A[1][r] + CA[2][c] * A[2][r];
        E[r][c] = (r == c ? image - Real(1.0) : image) * Real(0.5);
      }
    const Real density = stress_of_strain(material_, E, S);
    Real SA[3][3];  // times A^T
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        SA[r][c] = (S[r][0] * A[c][0] + S[r][1] * A[c][1] + S[r][2] * A[c][2]) * weighted_volume;
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c)
        total[r][c] += SA[0][c] * A[r][0] + SA[1][c] * A[r][1] + SA[2][c] * A[r][2];
    return density * weighted_volume;
  }

  /// F A_k = F + F G with the displacement gradient G of pose 0 against pose k, so that A_k = I +
  /// G.
  [[nodiscard]] PoseElement element(int t, int k) const {
    const RestTet& tet = energies_[k].rest.tets[t];
    PoseElement result;
    displacement_gradient(tet, offsets_[k].data(), result.map);
    for (int r = 0; r < 3; ++r) result.map[r][r] += 1.0;
    result.volume = tet.volume;
    return result;
  }

  StVK material_;
  std::vector<ElasticEnergy> energies_;
  std::vector<std::vector<double>> offsets_;
  std::vector<PoseElement> elements_;  // tet by tet, pose by pose
};

}  // namespace snapspace
