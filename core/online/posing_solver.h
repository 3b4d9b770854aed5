#pragma once
#include <utility>

#include "online/frame_minimizer.h"
#include "online/handle_quadric.h"
#include "online/inertial_minimizer.h"
#include "online/objective.h"

namespace snapspace::online {

/// Minimises the reduced posing energy, elastic energy + handle quadric, frame by frame.
/// This is the live loop. Its cost does not depend on the mesh, and it allocates no memory after
/// construction.
/// @tparam Elastic  Quartic or Cubature
template <class Elastic>
class PosingSolver final : public Objective {
 public:
  /// Copies K, L and S; see HandleQuadric for their shapes.
  PosingSolver(Elastic elastic, int handles, const double* K, const double* L, const double* S)
      : elastic_(std::move(elastic)),
        handles_(elastic_.dimension(), handles, K, L, S),
        minimizer_(elastic_.dimension(), elastic_.dimension(), Elastic::kHessianIsExpensive),
        valid_(minimizer_.prepare(*this, elastic_.dimension()) == Start::definite) {}

  /// False if the Hessian at rest is not positive definite: a solve then has no matrix to start
  /// from.
  [[nodiscard]] bool valid() const { return valid_; }

  [[nodiscard]] int handles() const { return handles_.handles(); }
  [[nodiscard]] int dimension() const { return elastic_.dimension(); }
  [[nodiscard]] int capacity() const { return elastic_.capacity(); }

  /// Restricts the problem to the first coordinates, 1 <= dimension <= capacity; offsets are kept.
  void set_dimension(int dimension) {
    elastic_.set_dimension(dimension);
    handles_.set_dimension(dimension);
    minimizer_.prepare(*this, dimension);
  }

  /// Sets the offsets of the handles (handles x 12): O(capacity * handles).
  void set_offsets(const double* offsets) { handles_.set_offsets(offsets); }

  double value_and_gradient(const double* q, double* gradient) override {
    const double elastic = elastic_.value_and_gradient(q, gradient);
    return elastic + handles_.add_value_and_gradient(half_runner(), q, gradient);
  }

  /// Also writes the lower triangle of the Hessian.
  double derivatives(const double* q, double* gradient, double* hessian) override {
    const double elastic = elastic_.derivatives(q, gradient, hessian);
    handles_.add_hessian(hessian);
    return elastic + handles_.add_value_and_gradient(half_runner(), q, gradient);
  }

  [[nodiscard]] HalfRunner* half_runner() const override { return elastic_.half_runner(); }

  /// Solves from q, in place. If q is the last frame of a drag, the solve starts where the drag is
  /// extrapolated to. The handles' pull is the input of a drag: it has the motions of all handles
  /// in one unit.
  Report solve(double* q, Method method, const Termination& stop) {
    return minimizer_.minimize(*this, handles_.pull(), method, q, stop);
  }

  /// A step in time from q to the next coordinates, in place; see InertialMinimizer.
  StepReport step(InertialMinimizer& inertia, double weight, const double* target, Method method,
                  double* q, const Termination& stop) {
    if (!inertia.is_prepared(dimension(), weight)) inertia.prepare(*this, dimension(), weight);
    return inertia.minimize(*this, target, method, Elastic::kHessianIsExpensive, q, stop);
  }

  /// The smallest curvature at rest.
  double softest(InertialMinimizer& inertia) { return inertia.softest(*this, dimension()); }

 private:
  Elastic elastic_;
  HandleQuadric handles_;
  FrameMinimizer minimizer_;
  bool valid_;
};

}  // namespace snapspace::online
