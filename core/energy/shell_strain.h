#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <cmath>

#include "energy/rotation_strain.h"
#include "material/hinge.h"

/// Rotations and strains of a shell's elements, as rotation_strain computes them for tets.
namespace snapspace {

/// The displacement gradient D of a triangle that turns by W and stretches by E, for the skew and
/// the symmetric part W and E of a gradient G.
/// @param frame  the tangent frame at rest, 3 x 2, row by row
template <class Real>
inline void triangle_rotation_strain(const double* frame, const Real G[3][3], Real D[3][3]) {
  using T = typename ScalarOf<Real>::type;
  Real t[3][2], n[3], in_space[3][3], along[3], turned[3][3];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 2; ++c) t[r][c] = Real(static_cast<T>(frame[2 * r + c]));
  for (int r = 0; r < 3; ++r) {
    const int s = (r + 1) % 3, q = (r + 2) % 3;
    n[r] = t[s][0] * t[q][1] - t[q][0] * t[s][1];
  }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) in_space[r][c] = G[r][0] * t[c][0] + G[r][1] * t[c][1];
  // The gradient along the normal is unknown; that of the rotation which moves the tangents is
  // used.
  for (int c = 0; c < 3; ++c)
    along[c] = n[0] * in_space[0][c] + n[1] * in_space[1][c] + n[2] * in_space[2][c];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) in_space[r][c] -= along[r] * n[c];
  rotation_strain(in_space, turned);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 2; ++c)
      D[r][c] = turned[r][0] * t[0][c] + turned[r][1] * t[1][c] + turned[r][2] * t[2][c];
    D[r][2] = Real(0.0);
  }
}

/// A hinge in the scalar matrix: the vector sum_j row_j edge_j, whose normal part is the
/// change of the angle in the plane (isometric bending, Bergou, Wardetzky, Harmon, Zorin, Grinspun
/// 2006).
class HingeVector {
 public:
  /// @param edges  at rest, 3 x 3, row by row: columns are the three edges from the first corner
  explicit HingeVector(const double* edges) {
    double E[3][3];
    for (int e = 0; e < 9; ++e) E[e / 3][e % 3] = edges[e];
    const HingeAngle<double> hinge(E);
    row[1] = hinge.edge / std::sqrt(hinge.first_square);
    row[2] = hinge.edge / std::sqrt(hinge.second_square);
    row[0] = -hinge.first_foot * row[1] - hinge.second_foot * row[2];
    edges_ = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(edges);
    const Eigen::Matrix3d outer = edges_ * edges_.transpose();
    inverse_inertia_ = (outer.trace() * Eigen::Matrix3d::Identity() - outer).inverse();
    rest_ = edges_ * Eigen::Vector3d(row[0], row[1], row[2]);
  }

  double row[3];  ///< of the three edges

  /// The change of the vector for displacements G of the edges (columns).
  template <class Real>
  void of(const Real G[3][3], Real vector[3]) const {
    using T = typename ScalarOf<Real>::type;
    for (int r = 0; r < 3; ++r)
      vector[r] = Real(static_cast<T>(row[0])) * G[r][0] + Real(static_cast<T>(row[1])) * G[r][1] +
                  Real(static_cast<T>(row[2])) * G[r][2];
  }

  /// The same for a hinge that turns by the rotation nearest to small displacements G, and bends as
  /// much as G bends it.
  template <class Real>
  void turned(const Real G[3][3], Real vector[3]) const {
    using T = typename ScalarOf<Real>::type;
    const auto real = [](double x) { return Real(static_cast<T>(x)); };
    Real moment[3], w[3];  // sum of edge x displacement, and the rotation vector
    for (int r = 0; r < 3; ++r) {
      const int s = (r + 1) % 3, t = (r + 2) % 3;
      moment[r] = Real(0.0);
      for (int j = 0; j < 3; ++j)
        moment[r] += real(edges_(s, j)) * G[t][j] - real(edges_(t, j)) * G[s][j];
    }
    for (int r = 0; r < 3; ++r)
      w[r] = real(inverse_inertia_(r, 0)) * moment[0] + real(inverse_inertia_(r, 1)) * moment[1] +
             real(inverse_inertia_(r, 2)) * moment[2];
    const Real zero(0.0);
    const Real skew[3][3] = {
        {zero, zero - w[2], w[1]}, {w[2], zero, zero - w[0]}, {zero - w[1], w[0], zero}};
    Real turn[3][3], bent[3], whole[3];  // turn = exp(skew) - I
    rotation_strain(skew, turn);
    of(G, bent);
    // bent in the frame at rest: the rotation's own part turns the vector only
    for (int r = 0; r < 3; ++r)
      bent[r] -=
          skew[r][0] * real(rest_[0]) + skew[r][1] * real(rest_[1]) + skew[r][2] * real(rest_[2]);
    for (int r = 0; r < 3; ++r) whole[r] = real(rest_[r]) + bent[r];
    for (int r = 0; r < 3; ++r)
      vector[r] = bent[r] + turn[r][0] * whole[0] + turn[r][1] * whole[1] + turn[r][2] * whole[2];
  }

 private:
  Eigen::Matrix3d edges_, inverse_inertia_;
  Eigen::Vector3d rest_;
};

}  // namespace snapspace
