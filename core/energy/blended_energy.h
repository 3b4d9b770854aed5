#pragma once
#include <algorithm>
#include <array>
#include <vector>

#include "energy/elastic_energy.h"

namespace snapspace {

/// Sum of weights_k * E_k, with pose k of one mesh as the rest shape of E_k (paper, sec. 3.3), as a
/// function of displacements u from pose 0.
///
/// All poses have the same tets. E_k takes displacements from pose k, which are u + offset_k with
/// the constant offset_k = pose 0 - pose k; the displacement gradient against pose k is then that
/// of u plus a constant.
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
      std::vector<Gradient>& gradients = base_gradients_.emplace_back(tet_count);
      for (int t = 0; t < tet_count; ++t) {
        double G[3][3];
        displacement_gradient(energies_[k].rest.tets[t], offset.data(), G);
        std::copy_n(&G[0][0], 9, gradients[t].begin());
      }
    }
  }

  [[nodiscard]] int poses() const { return static_cast<int>(energies_.size()); }
  [[nodiscard]] int size() const { return 3 * energies_[0].rest.vertex_count; }
  [[nodiscard]] const ElasticEnergy& energy(int pose) const { return energies_[pose]; }
  /// Pose 0 - this pose, 3n.
  [[nodiscard]] const std::vector<double>& offset(int pose) const { return offsets_[pose]; }

  /// Value at u; `gradient` (3n) is overwritten. The vertices are read and written once for all
  /// poses. @param weights  one per pose
  template <class Real>
  Real value_and_gradient(const Real* weights, const Real* u, Real* gradient) const {
    std::fill_n(gradient, size(), Real(0.0));
    Real energy(0.0);
    const std::size_t tets = energies_[0].rest.tets.size();
    for (std::size_t t = 0; t < tets; ++t) {
      Real D[3][3], forces[3][3];
      edge_displacements(energies_[0].rest.tets[t], u, D);
      for (auto& row : forces)
        for (Real& force : row) force = Real(0.0);
      for (std::size_t k = 0; k < energies_.size(); ++k) {
        const RestTet& tet = energies_[k].rest.tets[t];
        const Gradient& base = base_gradients_[k][t];
        Real G[3][3], S[3][3], P[3][3];
        gradient_of_edges(tet, D, G);
        for (int i = 0; i < 9; ++i) G[i / 3][i % 3] += Real(base[i]);
        const Real volume = weights[k] * Real(tet.volume);
        energy += stress(material_, G, S) * volume;
        first_stress(G, S, P);
        add_vertex_forces(tet, volume, P, forces);
      }
      scatter_forces(energies_[0].rest.tets[t], forces, gradient);
    }
    return energy;
  }

 private:
  using Gradient = std::array<double, 9>;

  StVK material_;
  std::vector<ElasticEnergy> energies_;
  std::vector<std::vector<double>> offsets_;
  std::vector<std::vector<Gradient>> base_gradients_;  // of the offsets, pose by pose, tet by tet
};

}  // namespace snapspace
