#pragma once
#include "material/triangle.h"
#include "simd/functions.h"

/// Densities of a membrane in plane stress, per area: functions of 2 E = F^T F - I, the doubled
/// Green strain of the 3 x 2 deformation gradient F. Symmetric 2 x 2 matrices are stored as xx, yy,
/// xy. `lam` is the first Lame parameter of plane stress, which is 2 lam mu / (lam + 2 mu) for a
/// solid's lam and mu: the thickness is free to change [Timoshenko & Goodier 1970].
///
/// A membrane has value_and_stress, which returns the density and sets the second Piola-Kirchhoff
/// stress S, and differential, which sets the change of S for a change of 2 E. Its Blend is the sum
/// over several poses, with F_k = F A_k relative to pose k.
namespace snapspace {

/// St.Venant-Kirchhoff in the plane: psi = mu |E|^2 + lam/2 tr(E)^2.
struct PlaneStVK {
  template <class Real>
  static Real value_and_stress(Real lam, Real mu, const Real E2[3], Real S[3]) {
    const Real pressure = rounded((E2[0] + E2[1]) * (lam * Real(0.5)));
    S[0] = E2[0] * mu + pressure;
    S[1] = E2[1] * mu + pressure;
    S[2] = E2[2] * mu;
    return Real(0.25) * (S[0] * E2[0] + rounded(S[1] * E2[1])) + rounded(Real(0.5) * S[2] * E2[2]);
  }

  static void differential(double lam, double mu, const double* /*E2*/, const double dE2[3],
                           double dS[3]) {
    double linear[3];
    value_and_stress(lam, mu, dE2, linear);
    for (int i = 0; i < 3; ++i) dS[i] = linear[i];
  }

  /// sum_k w_k psi_k(F A_k), collapsed. The strain relative to a pose is B e + d with e = 2 E and
  /// d = A^T A - I, so that the sum is the quadratic polynomial e^T Q e / 2 + l^T e + c.
  struct Blend {
    static constexpr int kNumbers = 10;  ///< Q (rows from the diagonal on), l, c

    static void fill(double lam, double mu, const double A[2][2], double* result) {
      const double B[3][3] = {
          {A[0][0] * A[0][0], A[1][0] * A[1][0], 2.0 * A[0][0] * A[1][0]},
          {A[0][1] * A[0][1], A[1][1] * A[1][1], 2.0 * A[0][1] * A[1][1]},
          {A[0][0] * A[0][1], A[1][0] * A[1][1], A[0][0] * A[1][1] + A[0][1] * A[1][0]}};
      double columns[4][3], stress[4][3];  // of B, and d
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) columns[j][i] = B[i][j];
        const int c = kPlaneEntries[i][0], d = kPlaneEntries[i][1];
        columns[3][i] = A[0][c] * A[0][d] + A[1][c] * A[1][d] - (c == d ? 1.0 : 0.0);
      }
      for (int j = 0; j < 4; ++j) {
        PlaneStVK::value_and_stress(lam, mu, columns[j], stress[j]);
        stress[j][2] *= 2.0;  // xy stands for two entries
      }
      double* next = result;
      for (int i = 0; i < 4; ++i)
        for (int j = i; j < 4; ++j) {
          double product = 0.0;
          for (int r = 0; r < 3; ++r) product += 0.5 * columns[i][r] * stress[j][r];
          if (j < 3)
            *next++ = product;
          else
            result[6 + i] = i < 3 ? product : 0.5 * product;
        }
    }

    template <class Real>
    static Real value_and_stress(const Real* numbers, const Real E2[3], Real S[3]) {
      Real forces[3];
      quadratic(numbers, E2, forces);
      Real value = numbers[9];
      for (int i = 0; i < 3; ++i) {
        value += E2[i] * (Real(0.5) * forces[i] + numbers[6 + i]);
        S[i] = forces[i] + numbers[6 + i];
      }
      S[0] += S[0];
      S[1] += S[1];
      return value;
    }

    static void differential(const double* numbers, const double* /*E2*/, const double dE2[3],
                             double dS[3]) {
      quadratic(numbers, dE2, dS);
      dS[0] += dS[0];
      dS[1] += dS[1];
    }

   private:
    /// Q e
    template <class Real>
    static void quadratic(const Real* Q, const Real e[3], Real product[3]) {
      product[0] = Q[0] * e[0] + rounded(Q[1] * e[1]) + Q[2] * e[2];
      product[1] = Q[1] * e[0] + rounded(Q[3] * e[1]) + Q[4] * e[2];
      product[2] = Q[2] * e[0] + rounded(Q[4] * e[1]) + Q[5] * e[2];
    }
  };
};

/// Stable neo-Hookean in the plane: psi = mu/2 (|F|^2 - 2) - mu (J - 1) + (lam + mu)/2 (J - 1)^2,
/// where J = sqrt(det(F^T F)) is the ratio of areas: the form of [Smith, de Goes, Kim 2018] for two
/// dimensions, with parameters that are those of small strains. It stays finite where a triangle
/// collapses, and a collapsed one is not a minimum.
struct PlaneNeoHookean {
  /// Nothing cancels for small strains: with the adjugate A of 2 E, S = ((lam + 2 mu) (J - 1) I +
  /// ((lam + mu) (J - 1) - mu) A) / J.
  template <class Real>
  static Real value_and_stress(Real lam, Real mu, const Real E2[3], Real S[3]) {
    const AreaChange<Real> area(E2);
    const Real volume = lam + mu, along = rounded((volume + mu) * area.change * area.inverse);
    const Real across = (volume * area.change - mu) * area.inverse;
    S[0] = along + across * E2[1];
    S[1] = along + across * E2[0];
    S[2] = Real(0.0) - across * E2[2];
    const Real half(0.5);
    // |F|^2 / 2 - J, without the terms that cancel
    const Real shear = half * (area.trace * area.change - area.determinant - area.determinant) /
                       (area.change + Real(2.0));
    return mu * shear + rounded(half * volume * area.change * area.change);
  }

  static void differential(double lam, double mu, const double E2[3], const double dE2[3],
                           double dS[3]) {
    const AreaChange<double> area(E2);
    // S = mu I + p Q with Q = adj(F^T F) / J, and dJ = Q : dE2 / 2
    const double Q[3] = {(1.0 + E2[1]) * area.inverse, (1.0 + E2[0]) * area.inverse,
                         -E2[2] * area.inverse};
    const double dJ = 0.5 * (Q[0] * dE2[0] + Q[1] * dE2[1]) + Q[2] * dE2[2];
    const double pressure = (lam + mu) * area.change - mu;
    const double change = (lam + mu) * dJ - pressure * dJ * area.inverse;
    dS[0] = change * Q[0] + pressure * dE2[1] * area.inverse;
    dS[1] = change * Q[1] + pressure * dE2[0] * area.inverse;
    dS[2] = change * Q[2] - pressure * dE2[2] * area.inverse;
  }

  /// sum_k w_k psi_k(F A_k), collapsed. With weighted moduli it is
  ///   tr(F M F^T) / 2 + alpha/2 J^2 - beta J + const,
  ///   M = sum mu A A^T,  alpha = sum (lam + mu) det(A)^2,  beta = sum (lam + 2 mu) det A.
  /// With gamma = alpha - beta and N = M + gamma I, which vanishes for pose 0 alone, it is
  ///   N : E + psi(E) + const,  with -gamma for mu and alpha for lam + mu in psi.
  struct Blend {
    static constexpr int kNumbers = 6;  ///< N, gamma, alpha, psi(A)

    static void fill(double lam, double mu, const double A[2][2], double* result) {
      const double det = A[0][0] * A[1][1] - A[0][1] * A[1][0];
      // N = mu (A A^T - I) + (gamma + mu) I
      const double shift = (det - 1.0) * ((lam + mu) * det - mu);
      double strain[3], stress[3];  // A^T A - I
      for (int i = 0; i < 3; ++i) {
        const int c = kPlaneEntries[i][0], d = kPlaneEntries[i][1];
        const double unit = c == d ? 1.0 : 0.0;
        result[i] = mu * (A[c][0] * A[d][0] + A[c][1] * A[d][1] - unit) + shift * unit;
        strain[i] = A[0][c] * A[0][d] + A[1][c] * A[1][d] - unit;
      }
      result[3] = shift - mu;
      result[4] = (lam + mu) * det * det;
      result[5] = PlaneNeoHookean::value_and_stress(lam, mu, strain, stress);
    }

    template <class Real>
    static Real value_and_stress(const Real* numbers, const Real E2[3], Real S[3]) {
      const Real value =
          PlaneNeoHookean::value_and_stress(numbers[4] + numbers[3], Real(0.0) - numbers[3], E2, S);
      for (int i = 0; i < 3; ++i) S[i] += numbers[i];
      const Real half(0.5);
      const Real diagonal = half * (numbers[0] * E2[0] + rounded(numbers[1] * E2[1]));
      return numbers[5] + (diagonal + rounded(numbers[2] * E2[2])) + value;
    }

    static void differential(const double* numbers, const double E2[3], const double dE2[3],
                             double dS[3]) {
      PlaneNeoHookean::differential(numbers[4] + numbers[3], -numbers[3], E2, dE2, dS);
    }
  };

 private:
  template <class Real>
  struct AreaChange {
    Real trace, determinant;  ///< of 2 E
    Real change;              ///< J - 1
    Real inverse;             ///< 1 / J

    explicit AreaChange(const Real E2[3])
        : trace(E2[0] + E2[1]), determinant(E2[0] * E2[1] - rounded(E2[2] * E2[2])) {
      const Real square = trace + determinant;  // J^2 - 1
      const Real J = sqrt(max(square + Real(1.0), Real(kLeastSquare)));
      change = square / (J + Real(1.0));
      inverse = Real(1.0) / J;
    }
  };
  /// The least J^2, for triangles that have collapsed to a line.
  static constexpr double kLeastSquare = 1e-12;
};

}  // namespace snapspace
