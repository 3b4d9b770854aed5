// The inner loops over tets. Only this file instantiates them, for every density and pack.
#include "energy/elastic_energy.h"

namespace snapspace {

template <>
const StreamedVector<double>& ElasticEnergy::weighted_moduli<double>() const {
  return moduli_;
}
template <>
const StreamedVector<float>& ElasticEnergy::weighted_moduli<float>() const {
  return single_moduli_;
}

template <class Real>
Sum<Real> ElasticEnergy::add_value_and_gradient(int begin, int end, const Real* u,
                                                Real* gradient) const {
  if (stars) return stars->add_value_and_gradient(begin, end, u, gradient);
  using T = typename ScalarOf<Real>::type;
  const RestTetOf<T>* const tets = rest.tets_in<T>().data();
  return Densities::with(material.view().kind, [&]<class Density>() {
    constexpr int kModuli = Density::kModuli;
    const T* moduli = weighted_moduli<T>().data() + std::size_t(begin) * kModuli;
    Sum<Real> energy(0.0);
    for (int t = begin; t < end; ++t, moduli += kModuli) {
      Real weighted[kModuli], G[3][3], P[3][3];
      for (int k = 0; k < kModuli; ++k) weighted[k] = Real(moduli[k]);
      displacement_gradient(tets[t], u, G);
      energy += widened(Density::value_and_stress(weighted, G, P));
      scatter_stress(tets[t], P, gradient);
    }
    return energy;
  });
}

template <class Real>
void ElasticEnergy::rest_hessian_product(const Real* v, Real* product) const {
  using T = typename ScalarOf<Real>::type;
  std::fill_n(product, 3 * rest.vertex_count, Real(0.0));
  if (stars) return stars->add_rest_product(v, product);
  if (rest.shell) return add_shell_rest_product(v, product);
  const double* lame = lame_.data();
  for (const RestTetOf<T>& tet : rest.tets_in<T>()) {
    const Real lam(static_cast<T>(lame[0])), mu(static_cast<T>(lame[1]));
    lame += 2;
    Real G[3][3], P[3][3];
    displacement_gradient(tet, v, G);
    const Real pressure = lam * (G[0][0] + G[1][1] + G[2][2]);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) P[r][c] = mu * (G[r][c] + G[c][r]);
      P[r][r] += pressure;
    }
    scatter_stress(tet, P, product);
  }
  const Real unit(static_cast<T>(force_unit_));
  for (int i = 0; i < 3 * rest.vertex_count; ++i) product[i] *= unit;
}

template <class Real>
void ElasticEnergy::add_shell_rest_product(const Real* v, Real* product) const {
  using T = typename ScalarOf<Real>::type;
  const auto& tets = rest.tets_in<T>();
  Densities::with(material.view().kind, [&]<class Density>() {
    if constexpr (kOfHinges<Density>) {
      const double* numbers = moduli_.data();
      for (const RestTetOf<T>& tet : tets) {
        Real G[3][3], P[3][3];
        displacement_gradient(tet, v, G);
        Density::rest_differential(numbers, G, P);
        scatter_stress(tet, P, product);
        numbers += Density::kModuli;
      }
    }
  });
}

#define SNAPSPACE_DEFINED(Real)                                                                 \
  template Sum<Real> ElasticEnergy::add_value_and_gradient(int, int, const Real*, Real*) const; \
  template void ElasticEnergy::rest_hessian_product(const Real*, Real*) const;
SNAPSPACE_LANE_PACKS(SNAPSPACE_DEFINED)
#undef SNAPSPACE_DEFINED

}  // namespace snapspace
