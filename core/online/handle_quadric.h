#pragma once
#include <cstddef>
#include <vector>

#include "online/half_runner.h"
#include "simd/vectors.h"

namespace snapspace::online {

/// The handle energy (paper, eq. 2) as a quadratic form in the reduced coordinates q (d) and the
/// offsets D_h (3 x 4) of the handles' affine maps from rest (paper, sec. 6.1):
///   q^T K q - 2 sum_h (L_h vec D_h) . q + sum_h tr(D_h S_h D_h^T).
/// D_h maps (rest position - centroid, 1) to the wanted displacement: (R - I, t) for a rigid motion
/// about the centroid. Offsets are used instead of maps because differences of large positions
/// would cancel.
class HandleQuadric {
 public:
  /// Copies the arrays.
  /// @param K  d x d
  /// @param L  handles x d x 12, row-major; the 12 entries of D_h are row by row
  /// @param S  handles x 4 x 4
  HandleQuadric(int dimension, int handles, const double* K, const double* L, const double* S)
      : capacity_(dimension),
        d_(dimension),
        handles_(handles),
        K_(K, K + size(dimension, dimension)),
        L_(L, L + size(handles, 12) * dimension),
        S_(S, S + size(handles, 16)),
        linear_(dimension) {}

  [[nodiscard]] int handles() const { return handles_; }

  /// Restricts the form to the first coordinates, at most as many as given to the constructor.
  void set_dimension(int dimension) { d_ = dimension; }

  /// Sets the offsets (handles x 12), for all coordinates: O(d * handles).
  void set_offsets(const double* offsets) {
    for (double& entry : linear_) entry = 0.0;
    constant_ = 0.0;
    for (int h = 0; h < handles_; ++h) {
      const double* D = offsets + size(12, h);
      for (int i = 0; i < capacity_; ++i)
        linear_[i] += dot(L_.data() + (size(h, capacity_) + i) * 12, D, 12);
      const double* S = S_.data() + size(16, h);
      for (int r = 0; r < 3; ++r)
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < 4; ++b) constant_ += D[4 * r + a] * S[4 * a + b] * D[4 * r + b];
    }
  }

  /// Minus half the gradient at q = 0, for all coordinates: linear in the offsets.
  [[nodiscard]] const double* pull() const { return linear_.data(); }

  /// Energy at q; its gradient is added to `gradient` (d). Results are the same without a runner.
  double add_value_and_gradient(HalfRunner* runner, const double* q, double* gradient) const {
    double values[2];
    run_halves(runner, size(d_, d_), [&](int half) {
      double value = 0.0;
      for (int i = half * d_ / 2; i < (half + 1) * d_ / 2; ++i) {
        const double Kq = dot(K_.data() + size(i, capacity_), q, d_);
        value += q[i] * (Kq - 2.0 * linear_[i]);
        gradient[i] += 2.0 * (Kq - linear_[i]);
      }
      values[half] = value;
    });
    return constant_ + values[0] + values[1];
  }

  /// Adds the constant Hessian 2 K to the lower triangle of `hessian` (d x d).
  void add_hessian(double* hessian) const {
    for (int i = 0; i < d_; ++i)
      add_scaled(2.0, K_.data() + size(i, capacity_), hessian + size(i, d_), i + 1);
  }

 private:
  static std::size_t size(int rows, int columns) {
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
  }

  int capacity_, d_, handles_;
  std::vector<double> K_, L_, S_;
  std::vector<double> linear_;
  double constant_ = 0.0;
};

}  // namespace snapspace::online
