#pragma once
#include <cstddef>
#include <vector>

namespace snapspace::online {

/// The handle energy (paper, eq. 2) as a quadratic form in the reduced coordinates q (d) and the
/// offsets D_h (3 x 4) of the handles' affine maps from rest (paper, sec. 6.1):
///   q^T K q - 2 sum_h (L_h vec D_h) . q + sum_h tr(D_h S_h D_h^T).
/// D_h maps (rest position - centroid, 1) to the wanted displacement: (R - I, t) for a rigid motion
/// about the centroid. Offsets instead of maps, because the differences of large positions would
/// cancel.
class HandleQuadric {
 public:
  /// Keeps pointers: the arrays must outlive it.
  /// @param K  d x d
  /// @param L  handles x d x 12, row-major, D_h row by row
  /// @param S  handles x 4 x 4
  HandleQuadric(int dimension, int handles, const double* K, const double* L, const double* S)
      : d_(dimension), handles_(handles), K_(K), L_(L), S_(S), linear_(dimension) {}

  [[nodiscard]] int handles() const { return handles_; }

  /// Takes new offsets (handles x 12): O(d * handles).
  void set_offsets(const double* offsets) {
    for (int i = 0; i < d_; ++i) linear_[i] = 0.0;
    constant_ = 0.0;
    for (int h = 0; h < handles_; ++h) {
      const double* D = offsets + 12 * h;
      for (int i = 0; i < d_; ++i) {
        const double* row = L_ + (static_cast<std::size_t>(h) * d_ + i) * 12;
        for (int k = 0; k < 12; ++k) linear_[i] += row[k] * D[k];
      }
      const double* S = S_ + 16 * h;
      for (int r = 0; r < 3; ++r)
        for (int a = 0; a < 4; ++a)
          for (int b = 0; b < 4; ++b) constant_ += D[4 * r + a] * S[4 * a + b] * D[4 * r + b];
    }
  }

  /// Energy at q; its gradient is added to `gradient` (d).
  double add_value_and_gradient(const double* q, double* gradient) const {
    double value = constant_;
    for (int i = 0; i < d_; ++i) {
      const double* row = K_ + static_cast<std::size_t>(i) * d_;
      double Kq = 0.0;
      for (int j = 0; j < d_; ++j) Kq += row[j] * q[j];
      value += q[i] * (Kq - 2.0 * linear_[i]);
      gradient[i] += 2.0 * (Kq - linear_[i]);
    }
    return value;
  }

  /// Adds the constant Hessian 2 K to `hessian` (d x d).
  void add_hessian(double* hessian) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(d_) * d_; ++i) hessian[i] += 2.0 * K_[i];
  }

 private:
  int d_;
  int handles_;
  const double* K_;
  const double* L_;
  const double* S_;
  std::vector<double> linear_;
  double constant_ = 0.0;
};

}  // namespace snapspace::online
