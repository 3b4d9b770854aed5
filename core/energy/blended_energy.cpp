#include "energy/blended_energy.h"

#include <algorithm>

namespace snapspace {

namespace {

/// F A - I = map + G + G map of the displacement gradient G against pose 0, map = A - I.
template <class Real>
void against_pose(const double map[3][3], const Real G[3][3], Real there[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      there[r][c] =
          Real(map[r][c]) + G[r][c] +
          (G[r][0] * Real(map[0][c]) + G[r][1] * Real(map[1][c]) + G[r][2] * Real(map[2][c]));
}

/// total += P A^T
template <class Real>
void add_stress(const double map[3][3], const Real P[3][3], Real total[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      total[r][c] += P[r][c] + (P[r][0] * Real(map[c][0]) + P[r][1] * Real(map[c][1]) +
                                P[r][2] * Real(map[c][2]));
}

}  // namespace

BlendedEnergy::BlendedEnergy(const double* poses, int count, int vertex_count,
                             const std::int32_t* tets, int tet_count,
                             const MaterialField& material) {
  const std::size_t size = 3 * static_cast<std::size_t>(vertex_count);
  for (int k = 0; k < count; ++k) {
    const double* pose = poses + k * size;
    energies_.emplace_back(RestShape(pose, vertex_count, tets, tet_count), material);
    std::vector<double>& offset = offsets_.emplace_back(poses, poses + size);
    for (std::size_t i = 0; i < size; ++i) offset[i] -= pose[i];
  }
  elements_.reserve(static_cast<std::size_t>(tet_count) * count);
  for (int t = 0; t < tet_count; ++t)
    for (int k = 0; k < count; ++k) elements_.push_back(element(t, k));
}

/// F A_k = F + F G with the displacement gradient G of pose 0 against pose k, so that A_k = I + G.
BlendedEnergy::PoseElement BlendedEnergy::element(int t, int k) const {
  const RestTet& tet = energies_[k].rest.tets[t];
  const TetMaterial material = energies_[k].material.view();
  PoseElement result = {};
  displacement_gradient(tet, offsets_[k].data(), result.map);
  for (int i = 0; i < material_moduli(material.kind); ++i)
    result.moduli[i] = tet.volume * material.of(t)[i];
  return result;
}

template <class Real>
Sum<Real> BlendedEnergy::value_and_gradient(const Real* weights, const Real* u, Real* gradient,
                                            int begin, int end) const {
  std::fill_n(gradient, size(), Real(0.0));
  return Densities::with(energies_[0].material.view().kind, [&]<class Density>() {
    Sum<Real> energy(0.0);
    const PoseElement* pose = elements_.data() + static_cast<std::size_t>(begin) * poses();
    for (int t = begin; t < end; ++t) {
      Real G[3][3], P[3][3], there[3][3], stress[3][3], moduli[Density::kModuli];
      displacement_gradient(energies_[0].rest.tets[t], u, G);
      for (auto& row : P)
        for (Real& entry : row) entry = Real(0.0);
      for (int k = 0; k < poses(); ++k, ++pose) {
        for (int i = 0; i < Density::kModuli; ++i) moduli[i] = weights[k] * Real(pose->moduli[i]);
        against_pose(pose->map, G, there);
        energy += widened(Density::value_and_stress(moduli, there, stress));
        add_stress(pose->map, stress, P);
      }
      scatter_stress(energies_[0].rest.tets[t], P, gradient);
    }
    return energy;
  });
}

#define SNAPSPACE_DEFINED(Real)                                                                   \
  template Sum<Real> BlendedEnergy::value_and_gradient(const Real*, const Real*, Real*, int, int) \
      const;
SNAPSPACE_PACKS(SNAPSPACE_DEFINED)
#undef SNAPSPACE_DEFINED

}  // namespace snapspace
