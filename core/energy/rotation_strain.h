#pragma once
#include "simd/lanes.h"

namespace snapspace {

/// D = exp(W) (I + E) - I for a displacement gradient G = W + E, with W skew and E symmetric. W is
/// interpreted as the logarithm of a rotation instead of its linear part (rotation-strain
/// coordinates, Huang, Tong, Zhou, Bao, Desbrun 2011). D = G + O(G^2).
template <class Real>
inline void rotation_strain(const Real G[3][3], Real D[3][3]) {
  using T = typename ScalarOf<Real>::type;
  const Real half(T(0.5));
  const Real w[3] = {half * (G[2][1] - G[1][2]), half * (G[0][2] - G[2][0]),
                     half * (G[1][0] - G[0][1])};
  // The cosine of a quarter of the angle, and its sine divided by the angle, as power series of the
  // square: ten digits for a whole turn, five for two. The angle is then doubled twice.
  const Real x = Real(T(1.0 / 16)) * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  const auto series = [&](auto... divisors) {
    Real sum(T(1));
    ((sum = Real(T(1)) - x * Real(T(1.0 / divisors)) * sum), ...);
    return sum;
  };
  Real cosine = series(182.0, 132.0, 90.0, 56.0, 30.0, 12.0, 2.0);
  Real sine = Real(T(0.25)) * series(210.0, 156.0, 110.0, 72.0, 42.0, 20.0, 6.0);
  sine = Real(T(2)) * cosine * sine;  // of half the angle, as in a quaternion
  cosine = Real(T(2)) * cosine * cosine - Real(T(1));
  const Real along = Real(T(2)) * cosine * sine, across = Real(T(2)) * sine * sine;
  // exp(W) - I = along W + across W^2, with W^2 = w w^T - |w|^2 I
  const Real square = Real(T(16)) * x;
  const Real turn[3][3] = {{across * (w[0] * w[0] - square), across * w[0] * w[1] - along * w[2],
                            across * w[0] * w[2] + along * w[1]},
                           {across * w[1] * w[0] + along * w[2], across * (w[1] * w[1] - square),
                            across * w[1] * w[2] - along * w[0]},
                           {across * w[2] * w[0] - along * w[1],
                            across * w[2] * w[1] + along * w[0], across * (w[2] * w[2] - square)}};
  Real strain[3][3];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) strain[r][c] = half * (G[r][c] + G[c][r]);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      D[r][c] = turn[r][c] + strain[r][c] + turn[r][0] * strain[0][c] + turn[r][1] * strain[1][c] +
                turn[r][2] * strain[2][c];
}

}  // namespace snapspace
