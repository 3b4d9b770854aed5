#pragma once
#include <cstddef>
#include <numeric>
#include <vector>

namespace snapspace {

inline double dot(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// y += scale * x
inline void add_scaled(std::vector<double>& y, double scale, const std::vector<double>& x) {
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += scale * x[i];
}

/// Preconditioned conjugate gradients on H d = -g. Reuses its memory for the next system.
///
/// H may have negative curvature: the iterate before such a direction is a descent direction and is
/// kept (Nocedal & Wright 2006, alg. 7.1).
class ConjugateGradients {
 public:
  explicit ConjugateGradients(std::size_t size)
      : residual_(size), preconditioned_(size), search_(size), product_(size) {}

  /// Writes d once the residual in the preconditioner's norm has fallen by the given ratio; returns
  /// the number of iterations.
  ///
  /// @param multiply      (v, product) writes H v
  /// @param precondition  (v, result) writes the preconditioner times v
  /// @param cancelled     () -> whether to stop early
  template <class Multiply, class Precondition, class Cancelled>
  int solve(const std::vector<double>& gradient, double relative_residual, int max_iterations,
            Multiply multiply, Precondition precondition, Cancelled cancelled,
            std::vector<double>& direction) {
    direction.assign(gradient.size(), 0.0);
    for (std::size_t i = 0; i < gradient.size(); ++i) residual_[i] = -gradient[i];
    precondition(residual_.data(), preconditioned_.data());
    search_ = preconditioned_;
    double norm = dot(residual_, preconditioned_);
    const double goal = norm * relative_residual * relative_residual;
    int iteration = 0;
    while (iteration < max_iterations && norm > goal && !cancelled()) {
      multiply(search_.data(), product_.data());
      ++iteration;
      const double curvature = dot(search_, product_);
      if (curvature <= 0.0) {
        if (iteration == 1) direction = search_;
        break;
      }
      const double step = norm / curvature;
      add_scaled(direction, step, search_);
      add_scaled(residual_, -step, product_);
      precondition(residual_.data(), preconditioned_.data());
      const double next = dot(residual_, preconditioned_);
      const double ratio = next / norm;
      norm = next;
      for (std::size_t i = 0; i < search_.size(); ++i)
        search_[i] = preconditioned_[i] + ratio * search_[i];
    }
    return iteration;
  }

 private:
  std::vector<double> residual_, preconditioned_, search_, product_;
};

}  // namespace snapspace
