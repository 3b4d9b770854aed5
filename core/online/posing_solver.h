#pragma once
#include <utility>

#include "online/frame_minimizer.h"
#include "online/handle_quadric.h"
#include "online/objective.h"

namespace snapspace::online {

/// Minimises the reduced posing energy, elastic energy + handle quadric, frame by frame.
///
/// This is the live loop. Its cost does not depend on the mesh, and it takes no memory after
/// construction.
/// @tparam Elastic  Quartic or Cubature
template <class Elastic>
class PosingSolver final : public Objective {
 public:
  /// Copies K, L and S, which are as HandleQuadric takes them.
  PosingSolver(Elastic elastic, int handles, const double* K, const double* L, const double* S)
      : elastic_(std::move(elastic)),
        handles_(elastic_.dimension(), handles, K, L, S),
        minimizer_(elastic_.dimension(), elastic_.dimension(), Elastic::kHessianIsDear),
        valid_(minimizer_.prepare(*this, elastic_.dimension()) == Start::definite) {}

  /// False if the Hessian at rest is not positive definite: a solve has then no matrix to start
  /// from.
  [[nodiscard]] bool valid() const { return valid_; }

  [[nodiscard]] int handles() const { return handles_.handles(); }
  [[nodiscard]] int dimension() const { return elastic_.dimension(); }
  [[nodiscard]] int capacity() const { return elastic_.capacity(); }

  /// Restricts the problem to the first coordinates, 1 <= dimension <= capacity; offsets stay.
  void set_dimension(int dimension) {
    elastic_.set_dimension(dimension);
    handles_.set_dimension(dimension);
    minimizer_.prepare(*this, dimension);
  }

  /// Takes new offsets of the handles (handles x 12): O(capacity * handles).
  void set_offsets(const double* offsets) { handles_.set_offsets(offsets); }

  double value_and_gradient(const double* q, double* gradient) override {
    const double elastic = elastic_.value_and_gradient(q, gradient);
    return elastic + handles_.add_value_and_gradient(q, gradient);
  }

  /// The lower triangle of the Hessian, too.
  double derivatives(const double* q, double* gradient, double* hessian) override {
    const double elastic = elastic_.derivatives(q, gradient, hessian);
    handles_.add_hessian(hessian);
    return elastic + handles_.add_value_and_gradient(q, gradient);
  }

  /// From q, in place, or from where a drag that q is the last frame of arrives. The handles' pull
  /// tells where a drag is: motions of them all in one unit.
  Report solve(double* q, Method method, const Termination& stop) {
    return minimizer_.minimize(*this, handles_.pull(), method, q, stop);
  }

 private:
  Elastic elastic_;
  HandleQuadric handles_;
  FrameMinimizer minimizer_;
  bool valid_;
};

}  // namespace snapspace::online
