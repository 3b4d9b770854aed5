#pragma once
#include "simd/functions.h"

/// Measures of how far a hinge is bent from its rest angle. A measure takes the sine and the cosine
/// of the angle theta, both times the same length, and the tangent of half the rest angle; it gives
/// f(theta) - f(rest angle), and its derivatives by theta.
namespace snapspace {

template <class Real>
struct Bend {
  Real strain, slope, curvature;
};

/// f = 2 tan(theta / 2), which grows without bound as a hinge folds onto itself: no fold collapses,
/// and none passes through itself [Grinspun, Hirani, Desbrun, Schroeder 2003; Tamstorf & Grinspun
/// 2013].
struct TangentBend {
  template <class Real>
  static Bend<Real> of(Real sine, Real cosine, Real length, Real rest) {
    // sine / (length + cosine) has no digits near a fold, and (length - cosine) / sine has none
    // near the plane.
    const Real tiny = Real(kNearest) * length + Real(kTiny), zero(0.0);
    const Real size = max(max(sine, zero - sine), tiny);
    const Real signed_size = select(is_less(sine, zero), zero - size, size);
    const Real flat = sine / max(length + cosine, tiny);
    const Real tangent = select(is_less(cosine, zero), (length - cosine) / signed_size, flat);
    const Real slope = Real(1.0) + tangent * tangent;
    return {Real(2.0) * (tangent - rest), slope, tangent * slope};
  }

 private:
  static constexpr double kNearest = 1e-10;  ///< to a fold, in radians
  static constexpr double kTiny = 1e-30;
};

/// f = theta [Grinspun, Hirani, Desbrun, Schroeder 2003]. The angle between the hinge and its rest
/// angle is taken as a whole, in [-pi, pi]: its square does not jump where theta passes pi.
struct AngleBend {
  template <class Real>
  static Bend<Real> of(Real sine, Real cosine, Real length, Real rest) {
    // The half angle has the tangent across / along. Both change sign beyond a half turn.
    const Real base = length + cosine, zero(0.0);
    const Real upward = base + rest * sine, across = sine - rest * base;
    const Real folded = is_less(upward, zero);
    const Real along = select(folded, zero - upward, upward);
    const Real turned = select(folded, zero - across, across);
    const Real norm = max(sqrt(along * along + turned * turned), Real(kTiny));
    // tangents of a quarter, an eighth and a sixteenth of the angle
    Real tangent = turned / (norm + along);
    for (int halving = 0; halving < 2; ++halving)
      tangent = tangent / (Real(1.0) + sqrt(Real(1.0) + tangent * tangent));
    // arctan to 17 digits, since |tangent| < 0.2
    const Real square = tangent * tangent;
    Real series(0.0);
    for (int n = 23; n > 0; n -= 2) series = Real(1.0 / n) - square * series;
    return {Real(16.0) * tangent * series, Real(1.0), zero};
  }

 private:
  static constexpr double kTiny = 1e-30;
};

}  // namespace snapspace
