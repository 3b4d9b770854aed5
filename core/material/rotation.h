#pragma once
#include "material/matrix3.h"
#include "simd/functions.h"

namespace snapspace {

/// How far F is from the nearest rotation R = U V^T of F = U diag(s) V^T, where the smallest
/// singular value has the sign of det F: inverted elements have one rotation too, the one that
/// turns least.
///
/// No decomposition is needed: f = tr(R^T F) = s_1 + s_2 + s_3 is the largest root of
/// f^4 - 2 |F|^2 f^2 - 8 J f + 2 |C|^2 - |F|^4, C = F^T F, whose roots are all real. Laguerre's
/// method comes down to it, cubically, in a fixed number of steps, so that lanes do the same. R is
/// then a polynomial of F over 2 (s_1 + s_2) (s_2 + s_3) (s_3 + s_1) [Cayley and Hamilton].
///
/// Where s_2 + s_3 vanishes R is not unique and the root a double one, found to a few digits only.
/// There, at mirror images and collapsed needles, R is zero, all is finite, and |F - R|^2 follows
/// from f, to 2e-3 (2e-2 in single precision).
template <class Real>
struct RotationDistance {
  Real difference[3][3];  ///< F - R
  Real square;            ///< |F - R|^2
  Real cofactor[3][3];    ///< of F
  Real J;                 ///< det F

  explicit RotationDistance(const Real G[3][3]) {
    Real F[3][3], C[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) F[r][c] = r == c ? G[r][c] + Real(T(1)) : G[r][c];
    for (int r = 0; r < 3; ++r)
      for (int c = r; c < 3; ++c)
        C[r][c] = C[c][r] = F[0][r] * F[0][c] + F[1][r] * F[1][c] + F[2][r] * F[2][c];
    cofactors(F, cofactor);
    J = F[0][0] * cofactor[0][0] + F[0][1] * cofactor[0][1] + F[0][2] * cofactor[0][2];
    const Real norm = C[0][0] + C[1][1] + C[2][2];
    const Real f = largest_root(norm, inner(C, C), J);

    const Real f2 = f * f, twice = f + f, scale = (norm + Real(kNothing)) * f;
    const Real product = (f2 - norm) * f - J - J;
    const Real unique = is_less(Real(kLeastProduct) * scale, product);
    const Real inverse = select(unique, Real(T(1)) / product, Real(T(0)));
    // R = (2 f cof F - F M) / product with M = 2 C - (f^2 + |F|^2) I
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) C[r][c] += C[r][c];
      C[r][r] -= f2 + norm;
    }
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        const Real FM = F[r][0] * C[0][c] + F[r][1] * C[1][c] + F[r][2] * C[2][c];
        difference[r][c] = F[r][c] - (rounded(twice * cofactor[r][c]) - FM) * inverse;
      }
    // The differences keep their digits near rest, the root near jumps of R, where both are large.
    square = select(is_less(Real(T(0.1)) * scale, product), inner(difference, difference),
                    norm - twice + Real(T(3)));
  }

 private:
  using T = typename ScalarOf<Real>::type;
  static constexpr bool kFloat = sizeof(T) == sizeof(float);
  static constexpr T kTiny = kFloat ? T(1e-30) : T(1e-300);
  static constexpr int kSteps = kFloat ? 3 : 5;
  /// Shares of |F|^2 f below which a product of sums, and a slope, are only rounding.
  static constexpr T kLeastProduct = kFloat ? T(1e-4) : T(1e-8);
  /// |F|^2 of no matrix: F is a sum that has such an error.
  static constexpr T kNothing = kFloat ? T(1e-10) : T(1e-24);
  /// The first f must be no less than the root, though inverses are rough.
  static constexpr T kAbove = kFloat ? T(1.0005) : T(1);
  static constexpr T kLeastSlope = kFloat ? T(1e-2) : T(1e-8);

  /// The polynomial is f^4 - 2 norm f^2 - 8 J f + 2 |C|^2 - norm^2. From f^2 = norm + 2 e,
  /// e^2 = |cof F|^2 + 2 J f: an upper bound of f on the right-hand side gives a better one on the
  /// left.
  static Real largest_root(const Real& norm, const Real& square_of_C, const Real& J) {
    const Real norm2 = rounded(norm * norm), zero(T(0));
    const Real last = square_of_C + square_of_C - norm2, eight_J = rounded(Real(T(8)) * J);
    const Real pairs = max(Real(T(0.5)) * (norm2 - square_of_C), zero);
    // f <= sqrt(3 norm) <= (norm + 3) / 2
    const Real bound = Real(T(0.5)) * norm + Real(T(1.5));
    const Real e = rough_root(pairs + rounded(Real(T(2)) * max(J, zero)) * bound);
    Real f = rough_root(norm + e + e) * Real(kAbove);
    for (int step = 0; step < kSteps; ++step) {
      const Real f2 = f * f;
      const Real value = ((f2 - norm - norm) * f - eight_J) * f + last;
      const Real slope = Real(T(4)) * ((f2 - norm) * f) - eight_J;
      const Real bend = Real(T(12)) * f2 - rounded(Real(T(4)) * norm);
      const Real root =
          rough_root(Real(T(9)) * (slope * slope) - rounded(Real(T(12)) * value * bend));
      const Real divisor = max(slope + root, Real(kLeastSlope) * norm * f + Real(kTiny));
      f -= rounded(Real(T(4)) * value) * rough_inverse(divisor);
    }
    return f;
  }

  /// The square root, roughly, and of what is not positive nearly zero.
  static Real rough_root(const Real& a) {
    const Real positive = max(a, Real(kTiny));
    return positive * rough_inverse_sqrt(positive);
  }
};

}  // namespace snapspace
