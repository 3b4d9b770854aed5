#include "energy/blended_energy.h"

#include <algorithm>
#include <type_traits>

#include "energy/shell_poses.h"
#include "material/pose_blend.h"

namespace snapspace {

namespace {

/// Numbers per pose and tet.
int numbers_of(int kind) {
  return Densities::with(kind, []<class Density>() { return PoseBlend<Density>::numbers(); });
}

/// How many of them are the same for all poses.
int constants_of(int kind) {
  return Densities::with(kind, []<class Density>() { return PoseBlend<Density>::constants(); });
}

bool collapses(int kind) {
  return Densities::with(kind, []<class Density>() { return PoseBlend<Density>::kCollapses; });
}

template <class Density>
constexpr bool kHasTetHessian = requires { &Density::Blend::hessian; };
template <class Density>
constexpr bool kHasScalarHessian = requires { &Density::Blend::scalar_hessian; };

}  // namespace

BlendedEnergy::BlendedEnergy(const double* poses, int count, int vertex_count,
                             const std::int32_t* tets, int tet_count,
                             const MaterialField& material) {
  const bool shell = is_of_shells(material.view().kind);
  const std::vector<MaterialField> materials =
      shell ? shell_pose_materials(poses, count, vertex_count, tets, tet_count, material)
            : std::vector<MaterialField>(count, material);
  const std::size_t size = 3 * static_cast<std::size_t>(vertex_count);
  for (int k = 0; k < count; ++k) {
    const double* pose = poses + k * size;
    energies_.emplace_back(RestShape(pose, vertex_count, tets, tet_count, shell), materials[k]);
    std::vector<double>& offset = offsets_.emplace_back(poses, poses + size);
    for (std::size_t i = 0; i < size; ++i) offset[i] -= pose[i];
  }
  if (energies_[0].stars) {
    std::vector<const VertexStars*> stars;
    for (const ElasticEnergy& energy : energies_) stars.push_back(&*energy.stars);
    stars_.emplace(stars, offsets_);
    return;
  }
  const int numbers = numbers_of(kind());
  numbers_.resize(static_cast<std::size_t>(tet_count) * count * numbers);
  double* next = numbers_.data();
  for (int t = 0; t < tet_count; ++t)
    for (int k = 0; k < count; ++k, next += numbers) fill_numbers(t, k, next);
}

/// F A_k = F + F G with the displacement gradient G of pose 0 relative to pose k, so that A_k = I +
/// G.
void BlendedEnergy::fill_numbers(int t, int k, double* result) const {
  const RestTet& tet = energies_[k].rest.tets[t];
  const TetMaterial material = energies_[k].material.view();
  double map[3][3], moduli[kMaxModuli];
  displacement_gradient(tet, offsets_[k].data(), map);
  scale_moduli(material.kind, material.of(t), tet.volume, moduli);
  const double* first = energies_[0].material.view().of(t);
  Densities::with(material.kind,
                  [&]<class Density>() { PoseBlend<Density>::fill(moduli, first, map, result); });
}

bool BlendedEnergy::keeps_sums() const { return collapses(kind()) && poses() > kFewPoses; }

std::size_t BlendedEnergy::blend_size() const {
  if (!keeps_sums()) return poses();
  return static_cast<std::size_t>(tets()) * numbers_of(kind());
}

template <class Real>
void BlendedEnergy::set_weights(int lane, const double* weights, Real* blend) const {
  if (!keeps_sums()) {
    for (int k = 0; k < poses(); ++k) set_lane(blend[k], lane, weights[k]);
    return;
  }
  std::vector<double> sums(numbers_of(kind()));
  for (int t = 0; t < tets(); ++t) {
    sum_numbers(t, weights, sums.data());
    for (const double sum : sums) set_lane(*blend++, lane, sum);
  }
}

void BlendedEnergy::sum_numbers(int tet, const double* weights, double* sums) const {
  const int numbers = numbers_of(kind()), summed = numbers - constants_of(kind());
  const double* pose = numbers_.data() + static_cast<std::size_t>(tet) * poses() * numbers;
  for (int i = 0; i < numbers; ++i) {
    sums[i] = i < summed ? 0.0 : pose[i];
    for (int k = 0; k < poses() && i < summed; ++k) sums[i] += weights[k] * pose[k * numbers + i];
  }
}

template <class Density, class Real>
Sum<Real> BlendedEnergy::tet_value_and_stress(int tet, const Real* blend, const Real G[3][3],
                                              Real P[3][3]) const {
  using Blend = PoseBlend<Density>;
  constexpr int kNumbers = Blend::numbers(), kSums = kNumbers - Blend::constants();
  const double* pose = numbers_.data() + static_cast<std::size_t>(tet) * poses() * kNumbers;
  if constexpr (Blend::kCollapses) {
    Real sums[kNumbers];
    const Real* numbers = sums;
    if (poses() > kFewPoses) {
      numbers = blend;
    } else {
      for (int i = 0; i < kSums; ++i) sums[i] = blend[0] * Real(pose[i]);
      for (int i = kSums; i < kNumbers; ++i) sums[i] = Real(pose[i]);
      for (int k = 1; k < poses(); ++k)
        for (int i = 0; i < kSums; ++i) sums[i] += blend[k] * Real(pose[k * kNumbers + i]);
    }
    return widened(Density::Blend::value_and_stress(numbers, G, P));
  } else {
    return sum_over_poses(poses(), Density::kModuli, blend, pose, G, P,
                          [](const Real* moduli, const Real at[3][3], Real stress[3][3]) {
                            return Density::value_and_stress(moduli, at, stress);
                          });
  }
}

/// Energy of some vertices and of the stars centered there; adds its gradient to `gradient`. A
/// single sample is a lane of a narrow pack, so its result is bitwise the same alone and beside
/// other samples.
template <class Real>
Sum<Real> BlendedEnergy::add_stars(const Real* blend, const Real* u, Real* gradient, int begin,
                                   int end) const {
  if constexpr (std::is_same_v<Real, double>) {
    using Pack = Lanes<2>;
    const std::vector<Pack> weights(blend, blend + poses()), shape(u, u + size());
    std::vector<Pack> forces(gradient, gradient + size());
    const Sum<Pack> energy = add_stars(weights.data(), shape.data(), forces.data(), begin, end);
    for (int i = 0; i < size(); ++i) gradient[i] = forces[i][0];
    return energy[0];
  } else if constexpr (std::is_same_v<typename ScalarOf<Real>::type, double>) {
    return stars_->add_value_and_gradient(blend, begin, end, u, gradient);
  } else {
    std::vector<Real> shape(size()), forces(size());
    Sum<Real> energy(0.0);
    const int first = stars_->first_star(begin), last = stars_->first_star(end);
    for (int k = 0; k < poses(); ++k) {
      for (int i = 0; i < size(); ++i) shape[i] = u[i] + Real(offsets_[k][i]);
      std::fill(forces.begin(), forces.end(), Real(0.0));
      energy += widened(blend[k]) *
                energies_[k].add_value_and_gradient(first, last, shape.data(), forces.data());
      for (int i = 0; i < size(); ++i) gradient[i] += blend[k] * forces[i];
    }
    return energy;
  }
}

template <class Real>
Sum<Real> BlendedEnergy::value_and_gradient(const Real* blend, const Real* u, Real* gradient,
                                            int begin, int end) const {
  std::fill_n(gradient, size(), Real(0.0));
  if (stars_) return add_stars(blend, u, gradient, begin, end);
  return Densities::with(kind(), [&]<class Density>() {
    const std::size_t own = keeps_sums() ? PoseBlend<Density>::numbers() : 0;
    Sum<Real> energy(0.0);
    for (int t = begin; t < end; ++t) {
      const auto& tet = energies_[0].rest.tets[t];
      Real G[3][3], P[3][3];
      displacement_gradient(tet, u, G);
      energy += tet_value_and_stress<Density>(t, blend + own * t, G, P);
      scatter_stress(tet, P, gradient);
    }
    return energy;
  });
}

void BlendedEnergy::tet_stresses(const std::vector<std::int32_t>& which, const double* weights,
                                 const double* u, double* stresses, double* energies) const {
  std::vector<double> sums(numbers_of(kind()));
  Densities::with(kind(), [&]<class Density>() {
    for (const std::int32_t t : which) {
      double G[3][3], P[3][3];
      displacement_gradient(energies_[0].rest.tets[t], u, G);
      if (keeps_sums()) sum_numbers(t, weights, sums.data());
      const double* blend = keeps_sums() ? sums.data() : weights;
      *energies++ = tet_value_and_stress<Density>(t, blend, G, P);
      for (const auto& row : P)
        for (const double entry : row) *stresses++ = entry;
    }
  });
}

bool BlendedEnergy::has_tet_hessians() const {
  return Densities::with(kind(), []<class Density>() { return kHasTetHessian<Density>; });
}

template <class Evaluate>
void BlendedEnergy::with_sums(int tet, const double* weights, const double* u,
                              Evaluate evaluate) const {
  double G[3][3];
  displacement_gradient(energies_[0].rest.tets[tet], u, G);
  Densities::with(kind(), [&]<class Density>() {
    double sums[PoseBlend<Density>::numbers()];
    sum_numbers(tet, weights, sums);
    evaluate(Density(), sums, G);
  });
}

void BlendedEnergy::tet_hessian(int tet, const double* weights, const double* u,
                                double H[9][9]) const {
  with_sums(tet, weights, u, [&]<class Density>(Density, const double* sums, const double G[3][3]) {
    if constexpr (kHasTetHessian<Density>) Density::Blend::hessian(sums, G, H);
  });
}

bool BlendedEnergy::has_scalar_hessians() const {
  return Densities::with(kind(), []<class Density>() { return kHasScalarHessian<Density>; });
}

void BlendedEnergy::scalar_hessian(int tet, const double* weights, const double* u,
                                   double D[3][3]) const {
  with_sums(tet, weights, u, [&]<class Density>(Density, const double* sums, const double G[3][3]) {
    if constexpr (kHasScalarHessian<Density>) Density::Blend::scalar_hessian(sums, G, D);
  });
}

#define SNAPSPACE_DEFINED(Real)                                                                   \
  template void BlendedEnergy::set_weights(int, const double*, Real*) const;                      \
  template Sum<Real> BlendedEnergy::value_and_gradient(const Real*, const Real*, Real*, int, int) \
      const;
SNAPSPACE_PACKS(SNAPSPACE_DEFINED)
#undef SNAPSPACE_DEFINED

}  // namespace snapspace
