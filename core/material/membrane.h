#pragma once
#include "simd/functions.h"

/// Densities of a membrane in plane stress, per area: functions of 2 E = F^T F - I, the doubled
/// Green strain of the 3 x 2 deformation gradient F. Symmetric 2 x 2 matrices are stored as xx, yy,
/// xy. `lam` is the first Lame parameter for the plane, 2 lam mu / (lam + 2 mu) of the solid's: the
/// thickness is free to change [Timoshenko & Goodier 1970].
///
/// A membrane has value_and_stress, which returns the density and sets the second Piola-Kirchhoff
/// stress S, and differential, which sets the change of S for a change of 2 E.
namespace snapspace {

/// St.Venant-Kirchhoff in the plane: psi = mu |E|^2 + lam/2 tr(E)^2.
struct PlaneStVK {
  template <class Real>
  static Real value_and_stress(Real lam, Real mu, const Real E2[3], Real S[3]) {
    const Real pressure = (E2[0] + E2[1]) * (lam * Real(0.5));
    S[0] = E2[0] * mu + pressure;
    S[1] = E2[1] * mu + pressure;
    S[2] = E2[2] * mu;
    return Real(0.25) * (S[0] * E2[0] + S[1] * E2[1]) + Real(0.5) * S[2] * E2[2];
  }

  static void differential(double lam, double mu, const double* /*E2*/, const double dE2[3],
                           double dS[3]) {
    double linear[3];
    value_and_stress(lam, mu, dE2, linear);
    for (int i = 0; i < 3; ++i) dS[i] = linear[i];
  }
};

/// Stable neo-Hookean in the plane: psi = mu/2 (|F|^2 - 2) - mu (J - 1) + (lam + mu)/2 (J - 1)^2,
/// where J = sqrt(det(F^T F)) is the ratio of areas: the form of [Smith, de Goes, Kim 2018] for two
/// dimensions, with parameters that are those of small strains. It stays finite where a triangle
/// collapses, and a collapsed one is not a minimum.
struct PlaneNeoHookean {
  /// Nothing cancels for small strains: with the adjugate A of 2 E, S = ((lam + 2 mu) (J - 1) I +
  /// ((lam + mu) (J - 1) - mu) A) / J.
  template <class Real>
  static Real value_and_stress(Real lam, Real mu, const Real E2[3], Real S[3]) {
    const AreaChange<Real> area(E2);
    const Real volume = lam + mu, along = (volume + mu) * area.change * area.inverse;
    const Real across = (volume * area.change - mu) * area.inverse;
    S[0] = along + across * E2[1];
    S[1] = along + across * E2[0];
    S[2] = Real(0.0) - across * E2[2];
    const Real half(0.5);
    // |F|^2 / 2 - J, without the terms that cancel
    const Real shear = half * (area.trace * area.change - area.determinant - area.determinant) /
                       (area.change + Real(2.0));
    return mu * shear + half * volume * area.change * area.change;
  }

  static void differential(double lam, double mu, const double E2[3], const double dE2[3],
                           double dS[3]) {
    const AreaChange<double> area(E2);
    // S = mu I + p Q with Q = adj(F^T F) / J, and dJ = Q : dE2 / 2
    const double Q[3] = {(1.0 + E2[1]) * area.inverse, (1.0 + E2[0]) * area.inverse,
                         -E2[2] * area.inverse};
    const double dJ = 0.5 * (Q[0] * dE2[0] + Q[1] * dE2[1]) + Q[2] * dE2[2];
    const double pressure = (lam + mu) * area.change - mu;
    const double change = (lam + mu) * dJ - pressure * dJ * area.inverse;
    dS[0] = change * Q[0] + pressure * dE2[1] * area.inverse;
    dS[1] = change * Q[1] + pressure * dE2[0] * area.inverse;
    dS[2] = change * Q[2] - pressure * dE2[2] * area.inverse;
  }

 private:
  template <class Real>
  struct AreaChange {
    Real trace, determinant;  ///< of 2 E
    Real change;              ///< J - 1
    Real inverse;             ///< 1 / J

    explicit AreaChange(const Real E2[3])
        : trace(E2[0] + E2[1]), determinant(E2[0] * E2[1] - E2[2] * E2[2]) {
      const Real square = trace + determinant;  // J^2 - 1
      const Real J = sqrt(max(square + Real(1.0), Real(kLeastSquare)));
      change = square / (J + Real(1.0));
      inverse = Real(1.0) / J;
    }
  };
  /// The least J^2, for triangles that have collapsed to a line.
  static constexpr double kLeastSquare = 1e-12;
};

}  // namespace snapspace
