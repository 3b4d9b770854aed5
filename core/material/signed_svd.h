#pragma once
#include <cmath>
#include <utility>

#include "material/matrix3.h"

namespace snapspace {

/// F = U diag(s) V^T with rotations U and V. Singular values descend, and the last one is negative
/// if F is inverted [Irving, Teran, Fedkiw 2004]. Found by one-sided Jacobi rotations [Hestenes
/// 1958], which give small singular values to full relative precision.
struct SignedSvd {
  double U[3][3], s[3], V[3][3];

  explicit SignedSvd(const double F[3][3]) {
    double A[3][3];  // F V, whose columns become orthogonal
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        A[r][c] = F[r][c];
        V[r][c] = r == c ? 1.0 : 0.0;
      }
    for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
      const int rotations = rotate(A, 0, 1) + rotate(A, 0, 2) + rotate(A, 1, 2);
      if (rotations == 0) break;
    }
    sort(A);
    make_u(A);
  }

 private:
  static constexpr int kMaxSweeps = 20;
  static constexpr double kOrthogonal = 1e-16;
  /// Singular values below this share of the largest have no well-defined direction.
  static constexpr double kNegligible = 1e-14;

  static double product(const double A[3][3], int p, int q) {
    return A[0][p] * A[0][q] + A[1][p] * A[1][q] + A[2][p] * A[2][q];
  }

  /// Makes two columns orthogonal. Returns whether they were not.
  bool rotate(double A[3][3], int p, int q) {
    const double a = product(A, p, p), b = product(A, q, q), c = product(A, p, q);
    if (!(std::abs(c) > kOrthogonal * std::sqrt(a * b))) return false;
    const double zeta = (b - a) / (2.0 * c);
    const double t = std::copysign(1.0, zeta) / (std::abs(zeta) + std::sqrt(1.0 + zeta * zeta));
    const double cosine = 1.0 / std::sqrt(1.0 + t * t), sine = cosine * t;
    for (auto* M : {A, V})
      for (int r = 0; r < 3; ++r) {
        const double x = M[r][p], y = M[r][q];
        M[r][p] = cosine * x - sine * y;
        M[r][q] = sine * x + cosine * y;
      }
    return true;
  }

  void sort(double A[3][3]) {
    for (int c = 0; c < 3; ++c) s[c] = std::sqrt(product(A, c, c));
    for (const auto& [p, q] : {std::pair(0, 1), std::pair(1, 2), std::pair(0, 1)}) {
      if (s[p] >= s[q]) continue;
      std::swap(s[p], s[q]);
      for (int r = 0; r < 3; ++r) {  // a quarter turn: V stays a rotation
        A[r][q] = -std::exchange(A[r][p], A[r][q]);
        V[r][q] = -std::exchange(V[r][p], V[r][q]);
      }
    }
  }

  /// U from the columns, completed where they vanish; the third is the cross product of the others.
  void make_u(const double A[3][3]) {
    if (!(s[0] > 0.0)) {
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) U[r][c] = V[r][c];
      return;
    }
    double first[3], second[3];
    for (int r = 0; r < 3; ++r) first[r] = A[r][0] / s[0];
    if (s[1] > kNegligible * s[0]) {
      for (int r = 0; r < 3; ++r) second[r] = A[r][1] / s[1];
    } else {
      // a coordinate axis far from the first direction, made orthogonal to it
      int axis = 0;
      for (int r = 1; r < 3; ++r)
        if (std::abs(first[r]) < std::abs(first[axis])) axis = r;
      double norm = 0.0;
      for (int r = 0; r < 3; ++r) {
        second[r] = (r == axis ? 1.0 : 0.0) - first[axis] * first[r];
        norm += second[r] * second[r];
      }
      for (double& entry : second) entry /= std::sqrt(norm);
    }
    for (int r = 0; r < 3; ++r) {
      const int a = (r + 1) % 3, b = (r + 2) % 3;
      U[r][0] = first[r];
      U[r][1] = second[r];
      U[r][2] = first[a] * second[b] - first[b] * second[a];
    }
    if (product_with_u(A) < 0.0) s[2] = -s[2];
  }

  [[nodiscard]] double product_with_u(const double A[3][3]) const {
    return A[0][2] * U[0][2] + A[1][2] * U[1][2] + A[2][2] * U[2][2];
  }
};

}  // namespace snapspace
