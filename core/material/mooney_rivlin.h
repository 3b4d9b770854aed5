#pragma once
#include "material/lame.h"
#include "material/matrix3.h"
#include "material/principal_curvature.h"

namespace snapspace {

/// Mooney-Rivlin: psi = mu1/2 (|F|^2 - 3) + mu2/2 (|cof F|^2 - 3) - (mu1 + 2 mu2) (J - 1) + (lam +
/// mu1)/2 (J - 1)^2 [Mooney 1940; Rivlin 1948; polyconvex, Ciarlet 1988, sec. 4.10]. A model of
/// rubber, whose stress under tension is lower than that of neo-Hookean material. With mu2 = 0 it
/// is stable neo-Hookean.
struct MooneyRivlin {
  static constexpr const char* kName = "mooney-rivlin";
  static constexpr int kModuli = 3;
  static constexpr const char* kModulusNames[kModuli] = {"lam", "mu1", "mu2"};

  static Lame small_strains(const double* moduli) { return {moduli[0], moduli[1] + moduli[2]}; }

  /// Written in the displacement gradient, with K = cof F - I, nothing cancels: the first terms are
  /// mu1 (|G|^2 / 2 - I_2(G) - det G) + mu2 (|K|^2 / 2 - I_2(G) - 2 det G).
  template <class Real>
  static Real value_and_stress(const Real* moduli, const Real G[3][3], Real P[3][3]) {
    const Real mu1 = moduli[1], mu2 = moduli[2], volume = moduli[0] + mu1;
    const VolumeChange<Real> change(G);
    const auto& K = change.cofactors;
    Real F[3][3], cofactor[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) F[r][c] = r == c ? G[r][c] + Real(1.0) : G[r][c];
    cofactors(G, cofactor);
    const Real pressure = volume * change.determinant, rest = pressure - mu1;
    for (int r = 0; r < 3; ++r) {
      const int r1 = (r + 1) % 3, r2 = (r + 2) % 3;
      for (int c = 0; c < 3; ++c) {
        const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        // derivative of |cof F|^2 / 2 at fixed cofactors: the cofactors' polar form of K and F
        const Real polar = (K[r1][c1] * F[r2][c2] - rounded(K[r1][c2] * F[r2][c1])) +
                           (F[r1][c1] * K[r2][c2] - rounded(F[r1][c2] * K[r2][c1]));
        P[r][c] =
            rest * K[r][c] + rounded(mu1 * G[r][c]) + mu2 * (polar - K[r][c] - cofactor[r][c]);
      }
      P[r][r] += pressure;
    }
    const Real both = change.second + change.third;
    return mu1 * (Real(0.5) * inner(G, G) - both) +
           rounded(mu2 * (Real(0.5) * inner(K, K) - both - change.third)) +
           Real(0.5) * pressure * change.determinant;
  }

  static PrincipalCurvature curvature(const double* moduli, const double s[3]) {
    const double mu1 = moduli[1], mu2 = moduli[2], volume = moduli[0] + mu1;
    const double pressure = volume * (s[0] * s[1] * s[2] - 1.0) - mu1 - 2.0 * mu2;
    PrincipalCurvature result;
    for (int i = 0; i < 3; ++i) {
      const int j = kPairs[i][0], k = kPairs[i][1];
      const double product = s[j] * s[k], squares = s[j] * s[j] + s[k] * s[k];
      result.scaling[i][i] = mu1 + mu2 * squares + volume * product * product;
      result.scaling[j][k] = result.scaling[k][j] =
          2.0 * mu2 * product + volume * s[i] * s[i] * product + pressure * s[i];
      const double even = mu1 + mu2 * s[i] * s[i], odd = mu2 * product + pressure * s[i];
      result.twist[i] = even + odd;
      result.flip[i] = even - odd;
    }
    return result;
  }
};

}  // namespace snapspace
