#pragma once
#include "material/lame.h"
#include "material/matrix3.h"
#include "material/principal_curvature.h"

namespace snapspace {

/// Stable neo-Hookean: psi = mu/2 (|F|^2 - 3) - mu (J - 1) + (lam + mu)/2 (J - 1)^2, J = det F
/// [Smith, de Goes, Kim 2018], without their barrier at F = 0 and with parameters for which small
/// strains are those of lam and mu. Polyconvex: a coarse mesh finds back from any inversion.
struct StableNeoHookean {
  static constexpr const char* kName = "stable-neo-hookean";
  static constexpr int kModuli = 2;
  static constexpr const char* kModulusNames[kModuli] = {"lam", "mu"};

  static Lame small_strains(const double* moduli) { return {moduli[0], moduli[1]}; }

  /// In the displacement gradient, where nothing cancels: the first two terms are mu (|G|^2 / 2 -
  /// I_2(G) - det G), and P = mu (G + I - cof F) + (lam + mu) (J - 1) cof F.
  template <class Real>
  static Real value_and_stress(const Real* moduli, const Real G[3][3], Real P[3][3]) {
    const Real mu = moduli[1], volume = moduli[0] + mu;
    const VolumeChange<Real> change(G);
    const Real pressure = volume * change.determinant, rest = pressure - mu;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) P[r][c] = rest * change.cofactors[r][c] + mu * G[r][c];
      P[r][r] += pressure;
    }
    return mu * (Real(0.5) * inner(G, G) - change.second - change.third) +
           Real(0.5) * pressure * change.determinant;
  }

  static PrincipalCurvature curvature(const double* moduli, const double s[3]) {
    const double mu = moduli[1], volume = moduli[0] + mu;
    // J and its derivatives by s: s_j s_k, and s_k
    const double pressure = volume * (s[0] * s[1] * s[2] - 1.0) - mu;
    PrincipalCurvature result;
    for (int i = 0; i < 3; ++i) {
      const int j = kPairs[i][0], k = kPairs[i][1];
      result.scaling[i][i] = mu + volume * s[j] * s[j] * s[k] * s[k];
      result.scaling[j][k] = result.scaling[k][j] =
          volume * s[i] * s[i] * s[j] * s[k] + pressure * s[i];
      result.twist[i] = mu + pressure * s[i];
      result.flip[i] = mu - pressure * s[i];
    }
    return result;
  }
};

}  // namespace snapspace
