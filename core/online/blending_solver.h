#pragma once
#include <utility>
#include <vector>

#include "online/frame_minimizer.h"
#include "online/inertial_minimizer.h"
#include "online/objective.h"

namespace snapspace::online {

/// Minimises the reduced interpolation energy sum_k w_k E_k(q) frame by frame. Allocates no memory
/// after construction.
/// @tparam Elastic  BlendedQuartic, BlendedCubature or BlendedStars
template <class Elastic>
class BlendingSolver final : public Objective {
 public:
  /// The weights are initially equal.
  explicit BlendingSolver(Elastic elastic)
      : elastic_(std::move(elastic)),
        weights_(elastic_.poses(), 1.0 / elastic_.poses()),
        equal_(weights_),
        minimizer_(elastic_.dimension(), elastic_.poses(), Elastic::kHessianIsExpensive) {
    elastic_.set_weights(equal_.data());
    valid_ = minimizer_.prepare(*this, dimension()) != Start::none;
  }

  /// False if no small multiple of the identity makes the Hessian at the mean shape, q = 0 at equal
  /// weights, positive definite: a solve then has no matrix to start from. The mean shape of poses
  /// that are far apart may be a saddle of the reduced energy, which is not an error.
  [[nodiscard]] bool valid() const { return valid_; }

  [[nodiscard]] int poses() const { return elastic_.poses(); }
  [[nodiscard]] int dimension() const { return elastic_.dimension(); }
  [[nodiscard]] int capacity() const { return elastic_.capacity(); }

  /// Restricts the problem to the first coordinates, 1 <= dimension <= capacity; weights are kept.
  void set_dimension(int dimension) {
    elastic_.set_dimension(dimension);
    at_equal_weights([&] { minimizer_.prepare(*this, dimension); });
  }

  /// Sets the weights of the poses.
  void set_weights(const double* weights) {
    weights_.assign(weights, weights + poses());
    elastic_.set_weights(weights);
  }

  double value_and_gradient(const double* q, double* gradient) override {
    return elastic_.value_and_gradient(q, gradient);
  }

  /// Also writes the lower triangle of the Hessian.
  double derivatives(const double* q, double* gradient, double* hessian) override {
    return elastic_.derivatives(q, gradient, hessian);
  }

  [[nodiscard]] HalfRunner* half_runner() const override { return elastic_.half_runner(); }

  /// Solves from q, in place. If q is the last frame of a drag, the solve starts where the drag is
  /// extrapolated to.
  Report solve(double* q, Method method, const Termination& stop) {
    return minimizer_.minimize(*this, weights_.data(), method, q, stop);
  }

  /// A step in time from q to the next coordinates, in place; see InertialMinimizer.
  StepReport step(InertialMinimizer& inertia, double weight, const double* target, Method method,
                  double* q, const Termination& stop) {
    if (!inertia.is_prepared(dimension(), weight))
      at_equal_weights([&] { inertia.prepare(*this, dimension(), weight); });
    return inertia.minimize(*this, target, method, Elastic::kHessianIsExpensive, q, stop);
  }

  /// The smallest curvature at the mean shape.
  double softest(InertialMinimizer& inertia) {
    double softest = 0.0;
    at_equal_weights([&] { softest = inertia.softest(*this, dimension()); });
    return softest;
  }

 private:
  template <class Act>
  void at_equal_weights(Act act) {
    elastic_.set_weights(equal_.data());
    act();
    elastic_.set_weights(weights_.data());
  }

  Elastic elastic_;
  std::vector<double> weights_, equal_;
  FrameMinimizer minimizer_;
  bool valid_ = false;
};

}  // namespace snapspace::online
