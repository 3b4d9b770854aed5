#pragma once
#include <utility>

#include "material/matrix3.h"
#include "simd/functions.h"

namespace snapspace {

/// The distance of F = U diag(s) V^T from the nearest rotation R = U V^T. The smallest singular
/// value has the sign of det F, so inverted elements also have a rotation: the one with the
/// smallest angle.
///
/// No decomposition is needed. With f = tr(R^T F) = s_1 + s_2 + s_3 and e = s_1 s_2 + s_2 s_3 +
/// s_3 s_1, f^2 = |F|^2 + 2 e, and e is the largest root of e^2 - |cof F|^2 - 2 J f(e). From an
/// upper bound down to it that function is convex and nearly quadratic. One step of Cauchy's
/// method, to the root of the local quadratic model, leaves an error below 3e-7 |F|^2, and one step
/// of Newton's method then leaves only rounding errors. Only inverted elements need more steps. How
/// many depends on how far each element is inverted, so lanes do not depend on each other. R is
/// then a polynomial of F over (s_1 + s_2) (s_2 + s_3) (s_3 + s_1) [Cayley and Hamilton]. Where s_2
/// + s_3 vanishes R is not unique, and e is a double root, found to a few digits only. There, at
/// mirror images and collapsed needles, R is shortened, everything stays finite, and |F - R|^2
/// follows from f, to 2e-3 (2e-2 in single precision).
template <class Real>
struct RotationDistance {
  Real difference[3][3];  ///< F - R
  Real square;            ///< |F - R|^2
  Real cofactor[3][3];    ///< of F
  Real J;                 ///< det F

  explicit RotationDistance(const Real G[3][3]) {
    Real F[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) F[r][c] = r == c ? G[r][c] + Real(T(1)) : G[r][c];
    cofactors(F, cofactor);
    J = F[0][0] * cofactor[0][0] + F[0][1] * cofactor[0][1] + F[0][2] * cofactor[0][2];
    const Real norm = inner(F, F);
    const auto [e, f] = sums(norm, inner(cofactor, cofactor));

    const Real scale = (norm + Real(kRounding)) * f, least = Real(kMinProduct) * scale;
    const Real product = max(e * f - J, least + Real(kTiny));
    // R = (e F + f cof F + F x cof F) / product. At rest F - R is exactly 0.
    const Real over_product = inverse(product), rest = product - e;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        const Real both = rounded(rest * F[r][c]) - f * cofactor[r][c];
        difference[r][c] = subtract_crossed(both, F, cofactor, r, c) * over_product;
      }
    // The differences keep their digits near rest; f keeps them near jumps of R, where the
    // differences are large.
    square = select(is_less(Real(T(0.05)) * scale, product), inner(difference, difference),
                    norm - f - f + Real(T(3)));
  }

 private:
  using T = typename ScalarOf<Real>::type;
  static constexpr bool kFloat = sizeof(T) == sizeof(float);
  static constexpr T kTiny = kFloat ? T(1e-30) : T(1e-300);
  static constexpr int kInvertedSteps = kFloat ? 4 : 5;
  /// The share of |F|^3 beyond which -J needs each of these steps. Nearly flat stars of surfaces
  /// are inverted a little as often as not.
  static constexpr T kInvertedFrom[5] = {T(1e-5), T(1e-3), T(1e-2), T(1e-2), T(1e-2)};
  /// Shares of |F|^2 f and |F|^2 below which a product of sums, and a slope, are only rounding.
  static constexpr T kMinProduct = kFloat ? T(5e-4) : T(1e-5);
  static constexpr T kMinSlope = kFloat ? T(1e-3) : T(1e-8);
  /// An |F|^2 that is only rounding: F is a sum with such an error.
  static constexpr T kRounding = kFloat ? T(1e-10) : T(1e-24);
  /// Keeps the first e above the root although inverses are approximate.
  static constexpr T kAbove = kFloat ? T(1.0005) : T(1);

  /// Roughly the square root; nearly zero if a is not positive.
  static Real rough_root(const Real& a) {
    const Real positive = max(a, Real(kTiny));
    return positive * rough_inverse_sqrt(positive);
  }

  static Real inverse(const Real& a) {
    const Real rough = rough_inverse(a);
    if constexpr (!kFloat) return rough;
    return rough + rough * (Real(T(1)) - a * rough);
  }

  /// The function of e whose root is sought: its value, f and 1 / f, and half its slope and
  /// curvature.
  struct LocalQuadratic {
    Real value, f, over_f, slope, curvature;

    LocalQuadratic(const Real& e, const Real& norm, const Real& square_of_cofactors,
                   const Real& J) {
      const Real square = max(norm + e + e, Real(kTiny));
      over_f = rough_inverse_sqrt(square);
      f = square * over_f;
      if constexpr (kFloat) f += (Real(T(0.5)) * over_f) * (square - f * f);
      value = (e * e - square_of_cofactors) - (J + J) * f;
      slope = e - J * over_f;
      curvature = Real(T(1)) + J * over_f * over_f * over_f;
    }
  };

  /// e and f. The first e is an upper bound: |F|^2 / 3 <= f^2 <= 3 |F|^2 in e^2 = |cof F|^2 + 2 J
  /// f.
  std::pair<Real, Real> sums(const Real& norm, const Real& square_of_cofactors) const {
    const Real least_slope = Real(kMinSlope) * norm + Real(kTiny);
    const Real length = rough_root(norm);
    const Real bound = max(Real(T(3)) * J, J) * length * Real(T(1.1547));
    Real e = rough_root(square_of_cofactors + bound) * Real(kAbove);
    const auto cauchy_step = [&] {
      const LocalQuadratic at(e, norm, square_of_cofactors, J);
      const Real root = rough_root(at.slope * at.slope - at.value * at.curvature);
      return at.value * rough_inverse(max(at.slope + root, least_slope));
    };
    e -= cauchy_step();
    for (int step = 0; step < kInvertedSteps; ++step) {
      const Real left = J + Real(kInvertedFrom[step]) * norm * length;
      if (!any_negative(left)) break;
      e -= select(is_less(left, Real(T(0))), cauchy_step(), Real(T(0)));
    }
    const LocalQuadratic at(e, norm, square_of_cofactors, J);
    e -= Real(T(0.5)) * at.value * rough_inverse(max(at.slope, least_slope));
    const Real f = at.f + Real(T(0.5)) * at.over_f * (norm + e + e - at.f * at.f);
    return {e, f};
  }
};

}  // namespace snapspace
