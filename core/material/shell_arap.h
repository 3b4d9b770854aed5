#pragma once
#include "material/arap.h"
#include "material/principal_map.h"

namespace snapspace {

/// A B^T
template <class Real>
inline void multiply_transposed(const Real A[3][3], const Real B[3][3], Real product[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      product[r][c] = A[r][0] * B[c][0] + A[r][1] * B[c][1] + A[r][2] * B[c][2];
}

/// R - I for the rotation R nearest to I + change.
template <class Real>
inline void turn_of(const Real change[3][3], Real turn[3][3]) {
  const RotationDistance<Real> distance(change);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) turn[r][c] = change[r][c] - distance.difference[r][c];
}

/// R - I for the rotation R nearest to S = (L + G) L^T.
template <class Real>
inline void nearest_turn(const Real L[3][3], const Real G[3][3], Real turn[3][3]) {
  Real F[3][3], change[3][3];  // change: S - I
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) F[r][c] = L[r][c] + G[r][c];
  multiply_transposed(F, L, change);
  for (int r = 0; r < 3; ++r) change[r][r] -= Real(1);
  turn_of(change, turn);
}

/// The derivative of the rotation nearest to S, from the Hessian of |S - R|^2 / 2.
class RotationDerivative {
 public:
  explicit RotationDerivative(const double S[3][3]) : distance_{SignedSvd(S), {}} {
    constexpr double kHalf = 0.5;
    distance_.curvature = Arap::curvature(&kHalf, distance_.frame.s);
  }

  /// The change of R for a change of S.
  void of(const double dS[3][3], double dR[3][3]) const {
    distance_.multiply(dS, dR);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) dR[r][c] = dS[r][c] - dR[r][c];
  }

 private:
  PrincipalMap distance_;
};

/// As-rigid-as-possible on surfaces, spokes and rims [Sorkine, Alexa 2007; Chao, Pinkall, Sanan,
/// Schroeder 2010]: psi = mu |F - R L|^2 with F = L + G and the rotation R nearest to F L^T.
///
/// An element is the star of a vertex, see VertexStars; L L^T is the mean of the projections onto
/// the planes of its triangles. For a single triangle, the first two columns of L are its tangent
/// frame, and those of G its displacement gradient (3 x 2), as in other shells.
struct ShellArap {
  static constexpr const char* kName = "shell-arap";
  static constexpr int kModuli = 12;
  static constexpr int kScaled = 3;
  static constexpr bool kOfStars = true;
  /// Two of the moduli of other shells are zero.
  static constexpr const char* kModulusNames[kModuli] = {"mu",     "lam",    "bending", "rest_0",
                                                         "rest_1", "rest_2", "rest_3",  "rest_4",
                                                         "rest_5", "rest_6", "rest_7",  "rest_8"};

  static Lame small_strains(const double* numbers) { return {0.0, numbers[0]}; }

  /// L: its first two columns row by row, and after them the third.
  template <class Number, class Real>
  static void frame(const Number* numbers, Real L[3][3]) {
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 2; ++c) L[r][c] = Real(numbers[kScaled + 2 * r + c]);
      L[r][2] = Real(numbers[kScaled + 6 + r]);
    }
  }

  template <class Real>
  static Real value_and_stress(const Real* numbers, const Real G[3][3], Real P[3][3]) {
    Real L[3][3], turn[3][3];
    frame(numbers, L);
    nearest_turn(L, G, turn);
    Real square(0.0);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        P[r][c] = G[r][c] - (turn[r][0] * L[0][c] + turn[r][1] * L[1][c] + turn[r][2] * L[2][c]);
        square += P[r][c] * P[r][c];
        P[r][c] *= numbers[0] + numbers[0];
      }
    return numbers[0] * square;
  }

  /// The Hessian (9 x 9) with respect to G.
  static void hessian(const double* numbers, const double G[3][3], double H[9][9]) {
    double L[3][3], F[3][3], S[3][3];
    frame(numbers, L);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) F[r][c] = L[r][c] + G[r][c];
    multiply_transposed(F, L, S);
    const RotationDerivative rotation(S);
    const double twice = 2.0 * numbers[0];
    for (int e = 0; e < 9; ++e) {
      double dS[3][3] = {}, dR[3][3];
      for (int c = 0; c < 3; ++c) dS[e / 3][c] = L[c][e % 3];
      rotation.of(dS, dR);
      for (int f = 0; f < 9; ++f) {
        const int r = f / 3, c = f % 3;
        const double turned = dR[r][0] * L[0][c] + dR[r][1] * L[1][c] + dR[r][2] * L[2][c];
        H[f][e] = twice * ((e == f ? 1.0 : 0.0) - turned);
      }
    }
  }
};

}  // namespace snapspace
