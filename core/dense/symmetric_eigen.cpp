#include "dense/symmetric_eigen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace snapspace {

namespace {

/// A plane rotation.
struct PlaneRotation {
  double cosine, sine;

  void apply(double& p, double& q) const {
    const double before = p;
    p = cosine * before - sine * q;
    q = sine * before + cosine * q;
  }
};

/// The smaller of the two rotations that make entry (p, q) zero.
PlaneRotation annihilating(double pp, double qq, double pq) {
  const double ratio = (qq - pp) / (2.0 * pq);
  const double tangent = std::copysign(1.0, ratio) / (std::abs(ratio) + std::hypot(1.0, ratio));
  const double cosine = 1.0 / std::hypot(1.0, tangent);
  return {cosine, tangent * cosine};
}

/// Rotates every pair of columns once. Returns whether any entry was not negligible.
bool sweep(SquareMatrix& A, SquareMatrix& vectors, double negligible) {
  bool rotated = false;
  for (int q = 1; q < A.size; ++q)
    for (int p = 0; p < q; ++p) {
      if (!(std::abs(A(p, q)) > negligible)) continue;
      rotated = true;
      const PlaneRotation rotation = annihilating(A(p, p), A(q, q), A(p, q));
      for (int i = 0; i < A.size; ++i) rotation.apply(A(i, p), A(i, q));
      for (int i = 0; i < A.size; ++i) rotation.apply(A(p, i), A(q, i));
      for (int i = 0; i < A.size; ++i) rotation.apply(vectors(i, p), vectors(i, q));
    }
  return rotated;
}

}  // namespace

EigenPairs symmetric_eigen(SquareMatrix A) {
  constexpr int kMaxSweeps = 40;  // ten suffice
  double largest = 0.0;
  SquareMatrix vectors(A.size);
  for (int j = 0; j < A.size; ++j) {
    vectors(j, j) = 1.0;
    for (int i = j; i < A.size; ++i) {
      A(j, i) = A(i, j);
      largest = std::max(largest, std::abs(A(i, j)));
    }
  }
  const double negligible = 0.01 * std::numeric_limits<double>::epsilon() * largest;
  for (int k = 0; k < kMaxSweeps && sweep(A, vectors, negligible); ++k) {
  }

  std::vector<int> order(A.size);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return A(a, a) < A(b, b); });
  EigenPairs result{{}, SquareMatrix(A.size)};
  for (int k = 0; k < A.size; ++k) {
    result.values.push_back(A(order[k], order[k]));
    for (int i = 0; i < A.size; ++i) result.vectors(i, k) = vectors(i, order[k]);
  }
  return result;
}

}  // namespace snapspace
