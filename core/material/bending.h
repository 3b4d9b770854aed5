#pragma once
#include "simd/functions.h"

/// Measures of how far a hinge is bent: functions f of its angle theta. The strain is f(theta) -
/// f(rest angle). A measure takes t = tan(theta / 2) and returns f and its derivatives with respect
/// to theta. All measures grow without bound as a hinge folds onto itself: no fold collapses or
/// passes through itself.
namespace snapspace {

template <class Real>
struct Bend {
  Real measure, slope, curvature;
};

/// f = 2 tan(theta / 2) [Grinspun, Hirani, Desbrun, Schroeder 2003; Tamstorf & Grinspun 2013].
struct TangentBend {
  template <class Real>
  static Bend<Real> of(Real t) {
    const Real slope = Real(1.0) + t * t;
    return {t + t, slope, t * slope};
  }
};

/// f = theta [Grinspun, Hirani, Desbrun, Schroeder 2003] plus a hundredth of the difference between
/// the other measure and theta: 0.3 % more at a right angle, 7 % at 170 degrees.
struct AngleBend {
  template <class Real>
  static Bend<Real> of(Real t) {
    // tangents of a quarter, an eighth and a sixteenth of the angle
    Real part = t;
    for (int halving = 0; halving < 3; ++halving)
      part = part / (Real(1.0) + sqrt(Real(1.0) + part * part));
    // arctan to 17 digits, since |part| < 0.2
    const Real square = part * part;
    Real series(0.0);
    for (int n = 23; n > 0; n -= 2) series = Real(1.0 / n) - square * series;
    const Real angle = rounded(Real(16.0) * part * series), share(kShare);
    return {angle + share * (t + t - angle), Real(1.0) + share * t * t,
            share * t * (Real(1.0) + t * t)};
  }

 private:
  static constexpr double kShare = 0.01;
};

/// tan(theta / 2) from the sine and the cosine of theta, both times the same length. Finite for
/// every hinge.
template <class Real>
inline Real half_tangent(Real sine, Real cosine, Real length) {
  constexpr double kNearest = 1e-10;  // to a fold, in radians
  constexpr double kTiny = 1e-30;
  // sine / (length + cosine) has no digits near a fold, and (length - cosine) / sine has none near
  // the plane.
  const Real tiny = Real(kNearest) * length + Real(kTiny), zero(0.0);
  const Real size = max(max(sine, zero - sine), tiny);
  const Real signed_size = select(is_less(sine, zero), zero - size, size);
  const Real flat = sine / max(length + cosine, tiny);
  return select(is_less(cosine, zero), (length - cosine) / signed_size, flat);
}

}  // namespace snapspace
