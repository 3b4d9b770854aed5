#pragma once
#include "material/lame.h"
#include "material/matrix3.h"
#include "material/principal_curvature.h"

namespace snapspace {

/// Stable neo-Hookean: psi = mu/2 (|F|^2 - 3) - mu (J - 1) + (lam + mu)/2 (J - 1)^2, J = det F
/// [Smith, de Goes, Kim 2018], without their barrier at F = 0 and with parameters chosen so that
/// lam and mu are those of small strains. Polyconvex: a coarse mesh recovers from any inversion.
struct StableNeoHookean {
  static constexpr const char* kName = "stable-neo-hookean";
  static constexpr int kModuli = 2;
  static constexpr const char* kModulusNames[kModuli] = {"lam", "mu"};

  static Lame small_strains(const double* moduli) { return {moduli[0], moduli[1]}; }

  /// Written in the displacement gradient, nothing cancels: the first two terms are mu (|G|^2 / 2 -
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
    // J and its derivatives with respect to s: s_j s_k, and s_k
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

  /// sum_k w_k psi_k(F A_k), collapsed. With weighted moduli and J = det F it is
  ///   tr(F M F^T) / 2 + alpha/2 J^2 - beta J + const,
  ///   M = sum mu A A^T,  alpha = sum (lam + mu) det(A)^2,  beta = sum (lam + 2 mu) det A.
  /// Written in the displacement gradient, little cancels near pose 0. With gamma = alpha - beta
  /// and N = M + gamma I, which vanishes for pose 0 alone, it is
  ///   tr(G N) + tr(G M G^T) / 2 + gamma (I_2(G) + det G) + alpha/2 (J - 1)^2 + psi(A).
  struct Blend {
    static constexpr int kNumbers = 9;  ///< N (xx, yy, zz, yz, xz, xy), gamma, alpha, psi(A)

    static void fill(const double* moduli, const double map[3][3], double* result) {
      const double lam = moduli[0], mu = moduli[1];
      double stress[3][3];
      const double change = VolumeChange<double>(map).determinant, det = 1.0 + change;
      // N = mu (A A^T - I) + (gamma + mu) I
      const double shift = change * ((lam + mu) * det - mu);
      for (int e = 0; e < 6; ++e) {
        const int r = kEntries[e][0], c = kEntries[e][1];
        const double square = map[r][0] * map[c][0] + map[r][1] * map[c][1] + map[r][2] * map[c][2];
        result[e] = mu * (map[r][c] + map[c][r] + square) + (r == c ? shift : 0.0);
      }
      result[6] = shift - mu;
      result[7] = (lam + mu) * det * det;
      result[8] = StableNeoHookean::value_and_stress(moduli, map, stress);
    }

    template <class Real>
    static Real value_and_stress(const Real* numbers, const Real G[3][3], Real P[3][3]) {
      const VolumeChange<Real> change(G);
      Real N[3][3], GN[3][3];
      for (int e = 0; e < 6; ++e)
        N[kEntries[e][0]][kEntries[e][1]] = N[kEntries[e][1]][kEntries[e][0]] = numbers[e];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          GN[r][c] = G[r][0] * N[0][c] + G[r][1] * N[1][c] + G[r][2] * N[2][c];
      const Real gamma = numbers[6], pressure = numbers[7] * change.determinant;
      const Real both = gamma + pressure;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          const Real linear = (N[r][c] + GN[r][c]) - gamma * G[r][c];
          P[r][c] = r == c ? (linear + pressure) + both * change.cofactors[r][c]
                           : linear + both * change.cofactors[r][c];
        }
      const Real half(0.5);
      const Real square = inner(G, N) + half * (inner(GN, G) - rounded(gamma * inner(G, G)));
      const Real volume = gamma * (change.second + change.third);
      return numbers[8] + (square + volume) + half * pressure * change.determinant;
    }

    /// The Hessian with respect to G: M, alpha cof F (x) cof F, and the derivative of cof F.
    static void hessian(const double* numbers, const double G[3][3], double H[9][9]) {
      const VolumeChange<double> change(G);
      const double gamma = numbers[6], alpha = numbers[7];
      const double both = gamma + alpha * change.determinant;
      double cofactors[9];
      for (int e = 0; e < 9; ++e)
        cofactors[e] = change.cofactors[e / 3][e % 3] + (e % 4 == 0 ? 1.0 : 0.0);
      for (int e = 0; e < 9; ++e)
        for (int f = 0; f < 9; ++f) H[e][f] = alpha * cofactors[e] * cofactors[f];
      for (int e = 0; e < 6; ++e)
        for (int r = 0; r < 3; ++r) {
          const int i = 3 * r + kEntries[e][0], j = 3 * r + kEntries[e][1];
          H[i][j] += i == j ? numbers[e] - gamma : numbers[e];
          if (i != j) H[j][i] += numbers[e];
        }
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) {
          const int s = (r + 1) % 3, t = (r + 2) % 3, d = (c + 1) % 3, f = (c + 2) % 3;
          const double entry = both * (G[r][c] + (r == c ? 1.0 : 0.0));  // of F
          H[3 * s + d][3 * t + f] += entry, H[3 * t + f][3 * s + d] += entry;
          H[3 * s + f][3 * t + d] -= entry, H[3 * t + d][3 * s + f] -= entry;
        }
    }

    /// What replaces the Hessian for each row of G: M + alpha/2 cof F^T cof F. The mean of the
    /// Hessian's blocks of single rows has alpha/3 instead, and nothing from the derivative of
    /// cof F. With alpha/2, samples of real poses take 3 to 10 % fewer evaluations, as the volume
    /// term also couples the rows.
    static void scalar_hessian(const double* numbers, const double G[3][3], double D[3][3]) {
      const VolumeChange<double> change(G);
      double cofactors[3][3];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) cofactors[r][c] = change.cofactors[r][c] + (r == c ? 1.0 : 0.0);
      for (int e = 0; e < 6; ++e) {
        const int c = kEntries[e][0], d = kEntries[e][1];
        const double square = cofactors[0][c] * cofactors[0][d] +
                              cofactors[1][c] * cofactors[1][d] + cofactors[2][c] * cofactors[2][d];
        D[c][d] = D[d][c] = numbers[e] - (c == d ? numbers[6] : 0.0) + 0.5 * numbers[7] * square;
      }
    }

   private:
    static constexpr int kEntries[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  };
};

}  // namespace snapspace
