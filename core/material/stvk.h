#pragma once
#include "material/lame.h"
#include "material/principal_curvature.h"

namespace snapspace {

/// St.Venant-Kirchhoff: psi = mu |E|^2 + lam/2 tr(E)^2 of the strain E = (F^T F - I) / 2 [Bonet &
/// Wood 2007]. It does not distinguish an inverted element from its mirror image: psi(F) = psi(-F).
struct StVK {
  static constexpr const char* kName = "stvk";
  static constexpr int kModuli = 2;
  static constexpr const char* kModulusNames[kModuli] = {"lam", "mu"};

  static Lame small_strains(const double* moduli) { return {moduli[0], moduli[1]}; }

  /// E = (G + G^T + G^T G) / 2 of the displacement gradient G keeps full precision for small
  /// deformations and on slivers, where F^T F - I cancels.
  template <class Real>
  static Real value_and_stress(const Real* moduli, const Real G[3][3], Real P[3][3]) {
    const Real lam = moduli[0], mu = moduli[1];
    Real E2[3][3], S[3][3];  // 2 E, and the second Piola-Kirchhoff stress 2 mu E + lam tr(E) I
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c)
        E2[r][c] = G[r][c] + G[c][r] + G[0][r] * G[0][c] + G[1][r] * G[1][c] + G[2][r] * G[2][c];
    const Real pressure = (E2[0][0] + E2[1][1] + E2[2][2]) * (lam * Real(0.5));
    for (int r = 0; r < 3; ++r) {
      S[r][r] = E2[r][r] * mu + pressure;
      for (int c = r + 1; c < 3; ++c) S[r][c] = S[c][r] = E2[r][c] * mu;
    }
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        P[r][c] = S[r][c] + G[r][0] * S[0][c] + G[r][1] * S[1][c] + G[r][2] * S[2][c];
    const Real diagonal = S[0][0] * E2[0][0] + S[1][1] * E2[1][1] + S[2][2] * E2[2][2];
    const Real others = S[0][1] * E2[0][1] + S[0][2] * E2[0][2] + S[1][2] * E2[1][2];
    return diagonal * Real(0.25) + others * Real(0.5);
  }

  /// psi = sum_i mu e_i^2 + lam/2 (sum_i e_i)^2 with e = (s^2 - 1) / 2.
  static PrincipalCurvature curvature(const double* moduli, const double s[3]) {
    const double lam = moduli[0], mu = moduli[1];
    PrincipalCurvature result;
    const double trace = 0.5 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2] - 3.0);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) result.scaling[i][j] = lam * s[i] * s[j];
      result.scaling[i][i] += mu * (3.0 * s[i] * s[i] - 1.0) + lam * trace;
      const double a = s[kPairs[i][0]], b = s[kPairs[i][1]];
      const double even = mu * (a * a + b * b - 1.0) + lam * trace, odd = mu * a * b;
      result.twist[i] = even - odd;
      result.flip[i] = even + odd;
    }
    return result;
  }
};

}  // namespace snapspace
