#pragma once

namespace snapspace {

/// The columns of a Hessian (9 x 9) with respect to the entries of G, from (dG, dP) -> sets the
/// change of the stress.
template <class Differential>
inline void hessian_of(const Differential& differential, double H[9][9]) {
  for (int e = 0; e < 9; ++e) {
    double dG[3][3] = {}, dP[3][3] = {};
    dG[e / 3][e % 3] = 1.0;
    differential(dG, dP);
    for (int f = 0; f < 9; ++f) H[f][e] = dP[f / 3][f % 3];
  }
}

}  // namespace snapspace
