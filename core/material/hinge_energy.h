#pragma once
#include "material/bending.h"
#include "material/hinge.h"

namespace snapspace {

/// The energy of a hinge as a function of its strain s, see bending.h: a quadratic polynomial times
/// a weight that vanishes where a triangle collapses,
///   (stiffness s^2 - 2 moment s + rest) / (2 cosh(rho)^2), with rho of HingeAreas.
/// With one rest angle, moment and rest are zero; a sum over several rest angles has all three.
template <class Real>
struct HingeForm {
  Real stiffness, moment, rest;
};

/// A hinge at the displacements G of its edges.
template <class Bending, class Real>
class HingeState {
 public:
  /// @param numbers  the measure at rest; the rest edges in units of the first, a 3 x 3 matrix, row
  ///                 by row; four times the product of both areas at rest
  HingeState(const Real* numbers, const Real G[3][3], const HingeForm<Real>& form)
      : edges_(numbers + 1, G),
        angle_(edges_.E),
        bend_(Bending::of(half_tangent(angle_.sine, angle_.cosine, angle_.length))),
        areas_(angle_, edges_.E, numbers[10]),
        form_(form),
        square_(areas_.weight * areas_.weight),
        slope_(form.stiffness * (bend_.measure - numbers[0]) - form.moment),
        twice_((bend_.measure - numbers[0]) * (slope_ - form.moment) + form.rest) {}

  /// Value, and its gradient P with respect to G.
  Real value_and_stress(Real P[3][3]) const {
    const Real force = square_ * slope_ * bend_.slope;
    const Real tension = Real(0.0) - square_ * twice_ * areas_.slope;
    for (int r = 0; r < 3; ++r) {
      P[r][0] = force * angle_.by_e[r] + rounded(tension * areas_.by_e[r]);
      P[r][1] = force * angle_.by_a[r] + rounded(tension * areas_.by_a[r]);
      P[r][2] = force * angle_.by_b[r] + rounded(tension * areas_.by_b[r]);
    }
    return Real(0.5) * square_ * twice_;
  }

  /// The change dP of that gradient for a change dG.
  void differential(const double dG[3][3], double dP[3][3]) const {
    double turn = 0.0, growth = 0.0;  // changes of the angle and of rho
    for (int r = 0; r < 3; ++r) {
      turn += angle_.by_e[r] * dG[r][0] + angle_.by_a[r] * dG[r][1] + angle_.by_b[r] * dG[r][2];
      growth += areas_.by_e[r] * dG[r][0] + areas_.by_a[r] * dG[r][1] + areas_.by_b[r] * dG[r][2];
    }
    // The weight w = 1 / cosh(rho)^2 has the derivatives -2 w tanh(rho) and w (6 tanh(rho)^2 - 2).
    const double by_angle = square_ * slope_ * bend_.slope,
                 by_areas = -square_ * twice_ * areas_.slope;
    const double angle_twice =
        square_ * (form_.stiffness * bend_.slope * bend_.slope + slope_ * bend_.curvature);
    const double mixed = -2.0 * areas_.slope * by_angle;
    const double areas_twice = square_ * twice_ * (3.0 * areas_.slope * areas_.slope - 1.0);
    const double along_angle = angle_twice * turn + mixed * growth;
    const double along_areas = mixed * turn + areas_twice * growth;
    double angle_change[3][3], areas_change[3][3];
    gradient_differentials(angle_, edges_.E, dG, angle_change, areas_change);
    const double* const of_angle[3] = {angle_.by_e, angle_.by_a, angle_.by_b};
    const double* const of_areas[3] = {areas_.by_e, areas_.by_a, areas_.by_b};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        dP[r][c] = along_angle * of_angle[c][r] + along_areas * of_areas[c][r] +
                   by_angle * angle_change[r][c] + by_areas * areas_change[r][c];
  }

 private:
  struct Edges {
    Real E[3][3];
    Edges(const Real* rest, const Real G[3][3]) {
      for (int e = 0; e < 9; ++e) E[e / 3][e % 3] = rest[e] + G[e / 3][e % 3];
    }
  };

  Edges edges_;
  HingeAngle<Real> angle_;
  Bend<Real> bend_;
  HingeAreas<Real> areas_;
  HingeForm<Real> form_;
  Real square_;  // of the weight
  Real slope_;   // half of the polynomial's derivative
  Real twice_;   // the polynomial
};

}  // namespace snapspace
