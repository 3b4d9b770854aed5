#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "online/minimizers.h"
#include "online/objective.h"

namespace snapspace::online {

/// Steps in time by implicit Euler: minimises objective + weight / 2 |q - target|^2, where target
/// has the coordinates that the body would reach without forces. Coordinates are M-orthonormal, so
/// that the mass matrix is the identity, and weight is density / dt^2 (Martin et al. 2011,
/// Example-based elastic materials, sec. 4). The constructor allocates all memory.
class InertialMinimizer {
 public:
  explicit InertialMinimizer(int capacity)
      : minimizers_(capacity), gradient_(capacity), vector_(capacity) {}

  /// Whether `prepare` was called for this dimension and weight.
  [[nodiscard]] bool is_prepared(int d, double weight) const {
    return d == d_ && weight == weight_;
  }

  /// Computes the Hessian at q = 0, in d dimensions, with the inertia of this weight. Where that is
  /// far from positive definite, solves start from that of a larger weight.
  void prepare(Objective& objective, int d, double weight) {
    d_ = d;
    weight_ = weight;
    for (double raised = weight; start(objective, raised) == Start::none; raised *= 4.0) {
    }
  }

  /// The smallest curvature of the objective at q = 0. Where that is not definite, the smallest
  /// positive one along a coordinate. Must be prepared again before the next step.
  double softest(Objective& objective, int d) {
    d_ = d;
    weight_ = -1.0;
    if (start(objective, 0.0) == Start::none) return minimizers_.softest_coordinate();
    return 1.0 / minimizers_.largest_of_inverse(vector_.data(), gradient_.data());
  }

  /// Minimises from q (d) or target, whichever is lower, into q.
  /// @param continues  whether BFGS keeps its approximation from step to step
  StepReport minimize(Objective& objective, const double* target, Method method, bool continues,
                      double* q, const Termination& stop) {
    Sum sum(objective, d_, weight_, target);
    const double before = objective.value_and_gradient(q, gradient_.data());
    const double at_target = objective.value_and_gradient(target, gradient_.data());
    if (at_target < before + sum.inertia(q)) std::copy_n(target, d_, q);
    Report report = continues && method == Method::bfgs
                        ? minimizers_.continue_bfgs(sum, q, stop)
                        : minimizers_.minimize(sum, method, q, stop);
    report.value -= sum.inertia(q);
    report.evaluations += 2;
    return {report, before};
  }

 private:
  /// The objective with the inertia.
  class Sum final : public Objective {
   public:
    Sum(Objective& objective, int d, double weight, const double* target)
        : objective_(objective), d_(d), weight_(weight), target_(target) {}

    [[nodiscard]] double inertia(const double* q) const {
      double square = 0.0;
      for (int i = 0; i < d_; ++i) square += (q[i] - target_[i]) * (q[i] - target_[i]);
      return 0.5 * weight_ * square;
    }
    double value_and_gradient(const double* q, double* gradient) override {
      const double value = objective_.value_and_gradient(q, gradient);
      add_pull(q, gradient);
      return value + inertia(q);
    }
    double derivatives(const double* q, double* gradient, double* hessian) override {
      const double value = objective_.derivatives(q, gradient, hessian);
      add_pull(q, gradient);
      for (int i = 0; i < d_; ++i) hessian[static_cast<std::size_t>(i) * (d_ + 1)] += weight_;
      return value + inertia(q);
    }
    [[nodiscard]] HalfRunner* half_runner() const override { return objective_.half_runner(); }

   private:
    void add_pull(const double* q, double* gradient) const {
      for (int i = 0; i < d_; ++i) gradient[i] += weight_ * (q[i] - target_[i]);
    }

    Objective& objective_;
    int d_;
    double weight_;
    const double* target_;
  };

  Start start(Objective& objective, double weight) {
    std::fill(vector_.begin(), vector_.end(), 0.0);
    Sum sum(objective, d_, weight, vector_.data());
    return minimizers_.prepare(sum, d_);
  }

  int d_ = 0;
  double weight_ = -1.0;
  Minimizers minimizers_;
  std::vector<double> gradient_, vector_;
};

}  // namespace snapspace::online
