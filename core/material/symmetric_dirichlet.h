#pragma once
#include <algorithm>
#include <limits>

#include "material/lame.h"
#include "material/matrix3.h"
#include "material/principal_curvature.h"
#include "simd/functions.h"

namespace snapspace {

/// Symmetric Dirichlet: psi = mu (|F|^2 + |F^-1|^2 - 6) / 4 [Smith & Schaefer 2015], infinite where
/// det F <= 0: a line search from a shape without inverted tets never inverts one.
struct SymmetricDirichlet {
  static constexpr const char* kName = "symmetric-dirichlet";
  static constexpr int kModuli = 1;
  static constexpr const char* kModulusNames[kModuli] = {"mu"};

  static Lame small_strains(const double* moduli) { return {0.0, moduli[0]}; }

  /// P = mu/2 (F - F^-T F^-1 F^-T), and F^-T = cof F / J. It is zero where psi is infinite.
  template <class Real>
  static Real value_and_stress(const Real* moduli, const Real G[3][3], Real P[3][3]) {
    using T = typename ScalarOf<Real>::type;
    const Real zero(T(0)), half_mu = moduli[0] * Real(T(0.5));
    Real F[3][3], C[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) F[r][c] = r == c ? G[r][c] + Real(T(1)) : G[r][c];
    cofactors(F, C);
    const Real J = F[0][0] * C[0][0] + F[0][1] * C[0][1] + F[0][2] * C[0][2];
    const Real valid = is_less(zero, J);
    const Real inverse = Real(T(1)) / select(valid, J, Real(T(1)));
    Real inverse_transpose[3][3], square[3][3];  // F^-T, and F^-1 F^-T
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) inverse_transpose[r][c] = C[r][c] * inverse;
    const auto& A = inverse_transpose;
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c)
        square[r][c] = square[c][r] = A[0][r] * A[0][c] + A[1][r] * A[1][c] + A[2][r] * A[2][c];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        const Real pushed =
            A[r][0] * square[0][c] + A[r][1] * square[1][c] + A[r][2] * square[2][c];
        P[r][c] = select(valid, half_mu * (F[r][c] - pushed), zero);
      }
    // |F|^2 + |F^-1|^2 - 6 without cancellation: |G|^2 + |H|^2 + 2 tr(G + H) with H = F^-1 - I =
    // -F^-1 G, and G + H = F^-1 G G
    Real H[3][3], mixed[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        H[r][c] = A[0][r] * G[0][c] + A[1][r] * G[1][c] + A[2][r] * G[2][c];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) mixed[r][c] = G[c][r];
    const Real trace = inner(H, mixed);  // of F^-1 G G
    const Real value = half_mu * Real(T(0.5)) * (inner(G, G) + inner(H, H) + (trace + trace));
    return select(valid, value, Real(std::numeric_limits<T>::infinity()));
  }

  /// g = mu/2 (s - s^-3). Stretches below kMinStretch count as kMinStretch: with s^-4 beyond
  /// 1e8 the factor of a preconditioner would lose its digits.
  static PrincipalCurvature curvature(const double* moduli, const double stretches[3]) {
    const double half_mu = 0.5 * moduli[0];
    double s[3];
    for (int i = 0; i < 3; ++i) s[i] = std::max(stretches[i], kMinStretch);
    PrincipalCurvature result = {};
    for (int i = 0; i < 3; ++i) {
      const double square = s[i] * s[i];
      result.scaling[i][i] = half_mu * (1.0 + 3.0 / (square * square));
      const double a = s[kPairs[i][0]], b = s[kPairs[i][1]], product = a * b;
      const double cube = product * product * product, squares = a * a + b * b;
      result.flip[i] = half_mu * (1.0 + (squares + product) / cube);
      result.twist[i] = half_mu * (1.0 - (squares - product) / cube);
    }
    return result;
  }

 private:
  static constexpr double kMinStretch = 0.01;
};

}  // namespace snapspace
