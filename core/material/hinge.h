#pragma once
#include "simd/functions.h"

namespace snapspace {

/// The angle between two triangles at their common edge, and its gradient. The hinge has the
/// vertices v0, v1 of the edge, and v2, v3 of the triangles v0 v1 v2 and v1 v0 v3. Its three edges
/// from v0 are e, a and b, to v1, v2 and v3. The angle is zero in the plane, and positive if v2 and
/// v3 are bent towards the normals. Triangles without area have finite values.
template <class Real>
struct HingeAngle {
  Real sine, cosine, length;       ///< length is the common factor of sine and cosine
  Real by_e[3], by_a[3], by_b[3];  ///< gradient of the angle
  Real first_foot, second_foot;    ///< where the heights of v2 and v3 meet the edge, from 0 to 1
  Real first_normal[3], second_normal[3];  ///< as long as twice the areas
  Real edge;                               ///< length of e
  Real first_square, second_square, edge_square;

  /// @param E  columns e, a and b, in units of about the edge
  explicit HingeAngle(const Real E[3][3]) {
    for (int r = 0; r < 3; ++r) {
      const int s = (r + 1) % 3, t = (r + 2) % 3;
      first_normal[r] = E[s][0] * E[t][1] - rounded(E[t][0] * E[s][1]);   // e x a
      second_normal[r] = E[s][2] * E[t][0] - rounded(E[t][2] * E[s][0]);  // b x e
    }
    const Real least(kLeastSquare);
    edge_square = max(product(E, 0, E, 0), least);
    first_square = max(product(first_normal, first_normal), least);
    second_square = max(product(second_normal, second_normal), least);
    edge = sqrt(edge_square);
    first_foot = product(E, 0, E, 1) / edge_square;
    second_foot = product(E, 0, E, 2) / edge_square;
    sine = edge * (first_normal[0] * E[0][2] + rounded(first_normal[1] * E[1][2]) +
                   first_normal[2] * E[2][2]);
    cosine = product(first_normal, second_normal);
    length = sqrt(first_square * second_square);
    const Real first = edge / first_square, second = edge / second_square;
    for (int r = 0; r < 3; ++r) {
      by_a[r] = first * first_normal[r];
      by_b[r] = second * second_normal[r];
      by_e[r] = Real(0.0) - (first_foot * by_a[r] + rounded(second_foot * by_b[r]));
    }
  }

  /// Squares of lengths and areas are not smaller than this, so that rounding bends no hinge whose
  /// triangle has collapsed.
  static constexpr double kLeastSquare =
      sizeof(typename ScalarOf<Real>::type) == sizeof(float) ? 1e-10 : 1e-20;
  static constexpr double kLeastProduct = 1e-30;

 private:
  static Real product(const Real x[3], const Real y[3]) {
    return x[0] * y[0] + rounded(x[1] * y[1]) + x[2] * y[2];
  }
  static Real product(const Real X[3][3], int i, const Real Y[3][3], int j) {
    return X[0][i] * Y[0][j] + rounded(X[1][i] * Y[1][j]) + X[2][i] * Y[2][j];
  }
};

/// How the areas of a hinge's triangles have changed: rho = ln(product of both areas / that at
/// rest), and its gradient. Where a triangle collapses, the gradient of the angle is not bounded;
/// bending is multiplied by 1 / cosh(rho), which is one at the rest areas, with zero slope, and
/// vanishes faster.
template <class Real>
struct HingeAreas {
  Real weight, slope;              ///< 1 / cosh(rho) and tanh(rho)
  Real by_e[3], by_a[3], by_b[3];  ///< gradient of rho

  /// @param rest  product of both areas at rest, times four
  HingeAreas(const HingeAngle<Real>& hinge, const Real E[3][3], Real rest) {
    const Real square = rounded(hinge.first_square * hinge.second_square);
    const Real at_rest = rounded(rest * rest);
    const Real sum = max(square + at_rest, Real(HingeAngle<Real>::kLeastProduct));
    weight = Real(2.0) * hinge.length * rest / sum;
    slope = (square - at_rest) / sum;
    const Real first = Real(1.0) / hinge.first_square, second = Real(1.0) / hinge.second_square;
    for (int r = 0; r < 3; ++r) {
      const int s = (r + 1) % 3, t = (r + 2) % 3;
      const Real *n = hinge.first_normal, *m = hinge.second_normal;
      by_a[r] = first * (n[s] * E[t][0] - rounded(n[t] * E[s][0]));   // n x e
      by_b[r] = second * (E[s][0] * m[t] - rounded(E[t][0] * m[s]));  // e x m
      const Real a_n = E[s][1] * n[t] - rounded(E[t][1] * n[s]);
      const Real m_b = m[s] * E[t][2] - rounded(m[t] * E[s][2]);
      by_e[r] = first * a_n + rounded(second * m_b);
    }
  }
};

/// Changes of the gradients of a hinge's angle and of rho, with columns as dE, for a change dE of
/// its edges.
inline void gradient_differentials(const HingeAngle<double>& hinge, const double E[3][3],
                                   const double dE[3][3], double change[3][3], double areas[3][3]) {
  const auto dot = [](const double* x, const double* y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  };
  double e[3], a[3], b[3], de[3], da[3], db[3];
  for (int r = 0; r < 3; ++r) {
    e[r] = E[r][0], a[r] = E[r][1], b[r] = E[r][2];
    de[r] = dE[r][0], da[r] = dE[r][1], db[r] = dE[r][2];
  }
  const double stretch = dot(e, de) / hinge.edge_square;
  const double first_foot =
      (dot(de, a) + dot(e, da)) / hinge.edge_square - 2.0 * stretch * hinge.first_foot;
  const double second_foot =
      (dot(de, b) + dot(e, db)) / hinge.edge_square - 2.0 * stretch * hinge.second_foot;
  double first[3], second[3];  // changes of the normals
  for (int r = 0; r < 3; ++r) {
    const int s = (r + 1) % 3, t = (r + 2) % 3;
    first[r] = de[s] * a[t] - de[t] * a[s] + e[s] * da[t] - e[t] * da[s];
    second[r] = db[s] * e[t] - db[t] * e[s] + b[s] * de[t] - b[t] * de[s];
  }
  const double first_growth = stretch - 2.0 * dot(hinge.first_normal, first) / hinge.first_square;
  const double second_growth =
      stretch - 2.0 * dot(hinge.second_normal, second) / hinge.second_square;
  const double *n = hinge.first_normal, *m = hinge.second_normal;
  const double n_growth = 2.0 * dot(n, first) / hinge.first_square;
  const double m_growth = 2.0 * dot(m, second) / hinge.second_square;
  for (int r = 0; r < 3; ++r) {
    change[r][1] = first_growth * hinge.by_a[r] + hinge.edge * first[r] / hinge.first_square;
    change[r][2] = second_growth * hinge.by_b[r] + hinge.edge * second[r] / hinge.second_square;
    change[r][0] = -first_foot * hinge.by_a[r] - hinge.first_foot * change[r][1] -
                   second_foot * hinge.by_b[r] - hinge.second_foot * change[r][2];
    // d(n x e / |n|^2), and so on
    const int s = (r + 1) % 3, t = (r + 2) % 3;
    const double n_e = n[s] * e[t] - n[t] * e[s], a_n = a[s] * n[t] - a[t] * n[s];
    const double e_m = e[s] * m[t] - e[t] * m[s], m_b = m[s] * b[t] - m[t] * b[s];
    areas[r][1] =
        (first[s] * e[t] - first[t] * e[s] + n[s] * de[t] - n[t] * de[s] - n_growth * n_e) /
        hinge.first_square;
    areas[r][2] =
        (de[s] * m[t] - de[t] * m[s] + e[s] * second[t] - e[t] * second[s] - m_growth * e_m) /
        hinge.second_square;
    areas[r][0] =
        (da[s] * n[t] - da[t] * n[s] + a[s] * first[t] - a[t] * first[s] - n_growth * a_n) /
            hinge.first_square +
        (second[s] * b[t] - second[t] * b[s] + m[s] * db[t] - m[t] * db[s] - m_growth * m_b) /
            hinge.second_square;
  }
}

}  // namespace snapspace
