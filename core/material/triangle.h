#pragma once
#include "simd/lanes.h"

/// The strain of a triangle between its rest shape and space. Symmetric 2 x 2 matrices are stored
/// as xx, yy, xy.
namespace snapspace {

/// Indices of the entries xx, yy and xy.
inline constexpr int kPlaneEntries[3][2] = {{0, 0}, {1, 1}, {0, 1}};

/// F^T G + G^T F, for the first two columns of G.
template <class Real>
inline void symmetric_product(const Real F[3][2], const Real G[3][3], Real result[3]) {
  for (int i = 0; i < 3; ++i) {
    const int c = kPlaneEntries[i][0], d = kPlaneEntries[i][1];
    result[i] = (F[0][c] * G[0][d] + rounded(F[1][c] * G[1][d]) + F[2][c] * G[2][d]) +
                (G[0][c] * F[0][d] + rounded(G[1][c] * F[1][d]) + G[2][c] * F[2][d]);
  }
}

/// P = F S; the third column is zero.
template <class Real>
inline void plane_stress(const Real F[3][2], const Real S[3], Real P[3][3]) {
  for (int r = 0; r < 3; ++r) {
    P[r][0] = F[r][0] * S[0] + rounded(F[r][1] * S[2]);
    P[r][1] = F[r][0] * S[2] + rounded(F[r][1] * S[1]);
    P[r][2] = Real(0.0);
  }
}

template <class Real>
struct TriangleStrain {
  Real F[3][2];  ///< deformation gradient: T + the first two columns of G
  Real E2[3];    ///< F^T F - I, the doubled Green strain

  /// @param frame  tangent frame T of the rest triangle, 3 x 2, row by row
  TriangleStrain(const Real* frame, const Real G[3][3]) {
    // T^T G + G^T T + G^T G keeps full precision where strains are small.
    Real T[3][2];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 2; ++c) {
        T[r][c] = frame[2 * r + c];
        F[r][c] = T[r][c] + G[r][c];
      }
    symmetric_product(T, G, E2);
    for (int i = 0; i < 3; ++i) {
      const int c = kPlaneEntries[i][0], d = kPlaneEntries[i][1];
      E2[i] += G[0][c] * G[0][d] + rounded(G[1][c] * G[1][d]) + G[2][c] * G[2][d];
    }
  }

  /// The change dP = F dS + dF S of the stress for a change dG.
  /// @param S  second Piola-Kirchhoff stress
  /// @param differential  (dE2, dS) -> sets the change of S
  template <class Differential>
  void stress_change(const Real S[3], const Real dG[3][3], Differential differential,
                     Real dP[3][3]) const {
    Real dE2[3], dS[3], along[3][3];
    symmetric_product(F, dG, dE2);
    differential(dE2, dS);
    plane_stress(F, dS, along);
    const Real dF[3][2] = {{dG[0][0], dG[0][1]}, {dG[1][0], dG[1][1]}, {dG[2][0], dG[2][1]}};
    plane_stress(dF, S, dP);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 2; ++c) dP[r][c] += along[r][c];
  }
};

}  // namespace snapspace
