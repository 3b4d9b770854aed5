#pragma once
/// 3 x 3 matrices as densities need them. Real is a number, or a pack with one tet or sample per
/// lane.
namespace snapspace {

/// Cofactors of M, the derivative of its determinant.
template <class Real>
inline void cofactors(const Real M[3][3], Real C[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      C[r][c] = M[r1][c1] * M[r2][c2] - M[r1][c2] * M[r2][c1];
    }
}

/// from - (A x B)_rc, where A x B is the derivative of A's cofactors along B.
template <class Real>
inline Real subtract_crossed(const Real& from, const Real A[3][3], const Real B[3][3], int r,
                             int c) {
  const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
  return from - A[r1][c1] * B[r2][c2] + A[r1][c2] * B[r2][c1] - A[r2][c2] * B[r1][c1] +
         A[r2][c1] * B[r1][c2];
}

/// sum_rc A_rc B_rc
template <class Real>
inline Real inner(const Real A[3][3], const Real B[3][3]) {
  return (A[0][0] * B[0][0] + A[0][1] * B[0][1] + A[0][2] * B[0][2]) +
         (A[1][0] * B[1][0] + A[1][1] * B[1][1] + A[1][2] * B[1][2]) +
         (A[2][0] * B[2][0] + A[2][1] * B[2][1] + A[2][2] * B[2][2]);
}

/// det(I + G) - 1 and cof(I + G) - I for a displacement gradient G. Both keep their digits where G
/// is small.
template <class Real>
struct VolumeChange {
  Real determinant;      ///< J - 1
  Real second;           ///< second invariant of G
  Real third;            ///< det G
  Real cofactors[3][3];  ///< cof F - I

  explicit VolumeChange(const Real G[3][3]) {
    snapspace::cofactors(G, cofactors);
    const Real trace = G[0][0] + G[1][1] + G[2][2];
    second = cofactors[0][0] + cofactors[1][1] + cofactors[2][2];
    third = G[0][0] * cofactors[0][0] + G[0][1] * cofactors[0][1] + G[0][2] * cofactors[0][2];
    determinant = trace + second + third;
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) cofactors[r][c] -= G[c][r];
      cofactors[r][r] += trace;
    }
  }
};

}  // namespace snapspace
