#pragma once
#include <algorithm>
#include <utility>

#include "energy/stvk.h"
#include "mesh/rest_shape.h"
#include "simd/lanes.h"

namespace snapspace {

/// Elastic energy of a mesh: the sum of its elements' energies, as a function of displacements
/// u (3n, x0 y0 z0 x1 ...) from the rest shape. Real is double, or Lanes for one sample per lane.
struct ElasticEnergy {
  RestShape rest;
  StVK material;

  /// Energy at u; `gradient` (3n) is overwritten. What the visitor does with a vertex before it is
  /// needed comes before u is read and the gradient written there.
  template <class Real, class Visitor = NoVisitor>
  Sum<Real> value_and_gradient(const Real* u, Real* gradient, Visitor&& visitor = {}) const {
    Sum<Real> energy(0.0);
    const auto* tet = rest.tets_in<typename ScalarOf<Real>::type>().data();
    const auto* const first = tet;
    SweepStop last{0, 0, 0};
    for (const SweepStop& stop : rest.stops) {
      visitor.before(last.reached, stop.reached);
      std::fill(gradient + 3 * last.reached, gradient + 3 * stop.reached, Real(0.0));
      for (; tet != first + stop.tets; ++tet)
        energy += widened(stvk_energy_and_gradient(material, *tet, u, gradient));
      visitor.after(last.complete, stop.complete);
      last = stop;
    }
    return energy;
  }

  /// Hessian at u times v; `product` (3n) is overwritten.
  template <class Real>
  void hessian_product(const Real* u, const Real* v, Real* product) const {
    std::fill_n(product, 3 * rest.vertex_count, Real(0.0));
    for (const RestTet& tet : rest.tets) stvk_hessian_product(material, tet, u, v, product);
  }

  /// Hessian at rest times v, which is linear elasticity; `product` (3n) is overwritten.
  template <class Real>
  void rest_hessian_product(const Real* v, Real* product) const {
    std::fill_n(product, 3 * rest.vertex_count, Real(0.0));
    for (const auto& tet : rest.tets_in<typename ScalarOf<Real>::type>())
      stvk_rest_hessian_product(material, tet, v, product);
  }

  /// Volume times first Piola-Kirchhoff stress (tets x 9, row by row) and energies (tets) at u.
  void tet_stresses(const double* u, double* stresses, double* energies) const {
    for (const RestTet& tet : rest.tets) {
      double G[3][3], S[3][3], P[3][3];
      displacement_gradient(tet, u, G);
      *energies++ = tet.volume * stress(material, G, S);
      first_stress(G, S, P);
      for (const auto& row : P)
        for (const double entry : row) *stresses++ = tet.volume * entry;
    }
  }

  /// Energy of a strain of 1e-12 everywhere. Where the minimum of an objective is zero, no share of
  /// it is ever reached: a decrease below this is none.
  [[nodiscard]] double negligible() const { return 1e-24 * material.mu * rest.volume(); }

  /// Number of elements with det F <= 0.
  [[nodiscard]] int inverted_tets(const double* u) const {
    return static_cast<int>(
        std::count_if(rest.tets.begin(), rest.tets.end(), [&](const RestTet& tet) {
          double F[3][3];
          displacement_gradient(tet, u, F);
          for (int r = 0; r < 3; ++r) F[r][r] += 1.0;
          const double det = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
                             F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                             F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
          return det <= 0.0;
        }));
  }
};

}  // namespace snapspace
