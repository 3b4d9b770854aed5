#pragma once
#include <cstddef>
#include <vector>

#include "simd/vectors.h"

namespace snapspace::online {

/// What is known of the solution beside the energy: coordinates a that it should be near, and the
/// force f that the reduced energy has there although the full one is in equilibrium,
///   strength (1/2 (q - a)^T W (q - a) - f . (q - a)).
/// With the strength 0, as at first, it costs nothing.
class Anchor {
 public:
  explicit Anchor(int capacity) : d_(capacity), target_(capacity), force_(capacity) {}

  /// Copies W (dimension x dimension), symmetric and positive semidefinite. Takes memory.
  void set_stiffness(const double* W) {
    stiffness_.assign(W, W + static_cast<std::size_t>(d_) * d_);
  }

  [[nodiscard]] bool has_stiffness() const { return !stiffness_.empty(); }

  /// For another number of coordinates: lets go, and forgets the stiffness.
  void set_dimension(int dimension) {
    d_ = dimension;
    strength_ = 0.0;
    stiffness_.clear();
  }

  /// Takes a and f (dimension). A strength above 0 needs a stiffness.
  void pull(const double* target, const double* force, double strength) {
    strength_ = strength;
    target_.assign(target, target + d_);
    force_.assign(force, force + d_);
  }

  /// Energy at q; its gradient is added to `gradient` (d).
  double add_value_and_gradient(const double* q, double* gradient) const {
    if (strength_ == 0.0) return 0.0;
    double value = 0.0;
    for (int i = 0; i < d_; ++i) {
      const double* W = row(i);
      const double pulled = dot(W, q, d_) - dot(W, target_.data(), d_);
      value += (q[i] - target_[i]) * (0.5 * pulled - force_[i]);
      gradient[i] += strength_ * (pulled - force_[i]);
    }
    return strength_ * value;
  }

  /// Adds the constant Hessian to the lower triangle of `hessian` (d x d).
  void add_hessian(double* hessian) const {
    if (strength_ == 0.0) return;
    for (int i = 0; i < d_; ++i)
      add_scaled(strength_, row(i), hessian + static_cast<std::size_t>(i) * d_, i + 1);
  }

 private:
  [[nodiscard]] const double* row(int i) const {
    return stiffness_.data() + static_cast<std::size_t>(i) * d_;
  }

  int d_;
  double strength_ = 0.0;
  std::vector<double> stiffness_, target_, force_;
};

}  // namespace snapspace::online
