#pragma once
#include "material/principal_hessian.h"

namespace snapspace {

/// The Hessian (9 x 9) of an element's density with respect to its displacement gradient, for any
/// density.
inline void element_hessian(const TetMaterial& material, int element, const double G[3][3],
                            double H[9][9]) {
  Densities::with(material.kind, [&]<class Density>() {
    if constexpr (kOfShells<Density>) {
      Density::hessian(material.of(element), G, H);
    } else {
      const PrincipalHessian principal(material, element, G);
      double unit[3][3], column[3][3];
      for (int e = 0; e < 9; ++e) {
        for (int f = 0; f < 9; ++f) unit[f / 3][f % 3] = e == f ? 1.0 : 0.0;
        principal.multiply(unit, column);
        for (int f = 0; f < 9; ++f) H[f][e] = column[f / 3][f % 3];
      }
    }
  });
}

/// Multiplies that Hessian by dF; for tets it is not formed.
inline void hessian_times(const TetMaterial& material, int element, const double G[3][3],
                          const double dF[3][3], double dP[3][3]) {
  if (!is_of_shells(material.kind)) {
    PrincipalHessian(material, element, G).multiply(dF, dP);
    return;
  }
  double H[9][9];
  element_hessian(material, element, G, H);
  for (int e = 0; e < 9; ++e) {
    dP[e / 3][e % 3] = 0.0;
    for (int f = 0; f < 9; ++f) dP[e / 3][e % 3] += H[e][f] * dF[f / 3][f % 3];
  }
}

}  // namespace snapspace
