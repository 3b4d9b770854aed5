#pragma once
#include "online/handle_quadric.h"
#include "online/minimizers.h"
#include "online/quartic.h"

namespace snapspace::online {

/// Minimises the reduced posing energy, elastic quartic + handle quadric, frame by frame.
///
/// This is the live loop. Its cost depends on the dimension and the number of handles only, and it
/// takes no memory after construction.
class PosingSolver {
 public:
  /// Copies the arrays, which are as Quartic and HandleQuadric take them.
  PosingSolver(int dimension, int handles, const double* quartic_coefficients, const double* K,
               const double* L, const double* S, Storage storage = Storage::double_precision)
      : elastic_(dimension, quartic_coefficients, storage),
        handles_(dimension, handles, K, L, S),
        minimizers_(dimension),
        valid_(minimizers_.prepare(*this, dimension)) {}

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
    minimizers_.prepare(*this, dimension);
  }

  /// Takes new offsets of the handles (handles x 12): O(capacity * handles).
  void set_offsets(const double* offsets) { handles_.set_offsets(offsets); }

  double value_and_gradient(const double* q, double* gradient) {
    const double elastic = elastic_.value_and_gradient(q, gradient);
    return elastic + handles_.add_value_and_gradient(q, gradient);
  }

  /// The lower triangle of the Hessian, too.
  double derivatives(const double* q, double* gradient, double* hessian) {
    const double elastic = elastic_.derivatives(q, gradient, hessian);
    handles_.add_hessian(hessian);
    return elastic + handles_.add_value_and_gradient(q, gradient);
  }

  /// From q, in place.
  Report solve(double* q, Method method, const Termination& stop) {
    return minimizers_.minimize(*this, method, q, stop);
  }

 private:
  Quartic elastic_;
  HandleQuadric handles_;
  Minimizers minimizers_;
  bool valid_;
};

}  // namespace snapspace::online
