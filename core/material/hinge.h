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
      first_normal[r] = E[s][0] * E[t][1] - E[t][0] * E[s][1];   // e x a
      second_normal[r] = E[s][2] * E[t][0] - E[t][2] * E[s][0];  // b x e
    }
    const Real least(kLeastSquare);
    edge_square = max(product(E, 0, E, 0), least);
    first_square = max(product(first_normal, first_normal), least);
    second_square = max(product(second_normal, second_normal), least);
    edge = sqrt(edge_square);
    first_foot = product(E, 0, E, 1) / edge_square;
    second_foot = product(E, 0, E, 2) / edge_square;
    sine =
        edge * (first_normal[0] * E[0][2] + first_normal[1] * E[1][2] + first_normal[2] * E[2][2]);
    cosine = product(first_normal, second_normal);
    length = sqrt(first_square * second_square);
    const Real first = edge / first_square, second = edge / second_square;
    for (int r = 0; r < 3; ++r) {
      by_a[r] = first * first_normal[r];
      by_b[r] = second * second_normal[r];
      by_e[r] = Real(0.0) - (first_foot * by_a[r] + second_foot * by_b[r]);
    }
  }

 private:
  /// Squares of lengths and areas are not smaller than this, so that rounding bends no hinge whose
  /// triangle has collapsed.
  static constexpr double kLeastSquare =
      sizeof(typename ScalarOf<Real>::type) == sizeof(float) ? 1e-10 : 1e-20;

  static Real product(const Real x[3], const Real y[3]) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  }
  static Real product(const Real X[3][3], int i, const Real Y[3][3], int j) {
    return X[0][i] * Y[0][j] + X[1][i] * Y[1][j] + X[2][i] * Y[2][j];
  }
};

/// Change of a hinge's gradient, with columns as dE, for a change dE of its edges.
inline void gradient_differential(const HingeAngle<double>& hinge, const double E[3][3],
                                  const double dE[3][3], double change[3][3]) {
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
  for (int r = 0; r < 3; ++r) {
    change[r][1] = first_growth * hinge.by_a[r] + hinge.edge * first[r] / hinge.first_square;
    change[r][2] = second_growth * hinge.by_b[r] + hinge.edge * second[r] / hinge.second_square;
    change[r][0] = -first_foot * hinge.by_a[r] - hinge.first_foot * change[r][1] -
                   second_foot * hinge.by_b[r] - hinge.second_foot * change[r][2];
  }
}

}  // namespace snapspace
