#pragma once
#include "online/drag_extrapolation.h"
#include "online/minimizers.h"
#include "online/objective.h"

namespace snapspace::online {

/// Minimises frame after frame: from where a drag arrives, and with what is known of the Hessian.
/// Takes no memory after construction.
class FrameMinimizer {
 public:
  /// @param inputs  numbers that a frame sets, see DragExtrapolation
  /// @param hessian_is_dear  then BFGS keeps its approximation from frame to frame
  FrameMinimizer(int capacity, int inputs, bool hessian_is_dear)
      : hessian_is_dear_(hessian_is_dear), minimizers_(capacity), drag_(capacity, inputs) {}

  /// As Minimizers::prepare; a new drag begins.
  Start prepare(Objective& objective, int d) {
    d_ = d;
    drag_.clear();
    return minimizers_.prepare(objective, d);
  }

  /// From q (d), in place, or from where a drag that q is the last frame of arrives.
  Report minimize(Objective& objective, const double* inputs, Method method, double* q,
                  const Termination& stop) {
    drag_.go_on(d_, inputs, q);
    const Report report = hessian_is_dear_ && method == Method::bfgs
                              ? minimizers_.minimize_onwards(objective, q, stop)
                              : minimizers_.minimize(objective, method, q, stop);
    if (report.status == Status::converged)
      drag_.add(d_, inputs, q);
    else
      drag_.clear();
    return report;
  }

 private:
  bool hessian_is_dear_;
  int d_ = 0;
  Minimizers minimizers_;
  DragExtrapolation drag_;
};

}  // namespace snapspace::online
