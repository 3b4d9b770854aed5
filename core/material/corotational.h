#pragma once
#include "material/arap.h"

namespace snapspace {

/// Fixed corotational: psi = mu |F - R|^2 + lam/2 (J - 1)^2, with the rotation R nearest to F
/// [Stomakhin, Howes, Schroeder, Teran 2012].
struct Corotational {
  static constexpr const char* kName = "corotational";
  static constexpr int kModuli = 2;
  static constexpr const char* kModulusNames[kModuli] = {"lam", "mu"};

  static Lame small_strains(const double* moduli) { return {moduli[0], moduli[1]}; }

  /// J - 1 cancels near rest, but loses no more digits than F - R does.
  template <class Real>
  static Real value_and_stress(const Real* moduli, const Real G[3][3], Real P[3][3]) {
    const RotationDistance<Real> distance(G);
    const Real mu = moduli[1], twice = mu + mu, change = distance.J - Real(1.0);
    const Real pressure = moduli[0] * change;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        P[r][c] = pressure * distance.cofactor[r][c] + rounded(twice * distance.difference[r][c]);
    return mu * distance.square + rounded(Real(0.5) * pressure * change);
  }

  static PrincipalCurvature curvature(const double* moduli, const double s[3]) {
    PrincipalCurvature result = Arap::curvature(moduli + 1, s);
    const double lam = moduli[0], pressure = lam * (s[0] * s[1] * s[2] - 1.0);
    for (int i = 0; i < 3; ++i) {
      const int j = kPairs[i][0], k = kPairs[i][1];
      const double mixed = lam * s[i] * s[i] * s[j] * s[k] + pressure * s[i];
      result.scaling[i][i] += lam * s[j] * s[j] * s[k] * s[k];
      result.scaling[j][k] += mixed;
      result.scaling[k][j] += mixed;
      result.twist[i] += pressure * s[i];
      result.flip[i] -= pressure * s[i];
    }
    return result;
  }
};

}  // namespace snapspace
