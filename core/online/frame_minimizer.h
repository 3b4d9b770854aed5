#pragma once
#include "online/drag_extrapolation.h"
#include "online/minimizers.h"
#include "online/objective.h"

namespace snapspace::online {

/// Minimises frame after frame: starts where a drag is extrapolated to, and reuses what is known of
/// the Hessian. Allocates no memory after construction.
class FrameMinimizer {
 public:
  /// @param inputs  count of the numbers that a frame sets, see DragExtrapolation
  /// @param hessian_is_expensive  if so, BFGS keeps its approximation from frame to frame
  FrameMinimizer(int capacity, int inputs, bool hessian_is_expensive)
      : hessian_is_expensive_(hessian_is_expensive),
        minimizers_(capacity),
        drag_(capacity, inputs) {}

  /// The same as Minimizers::prepare; a new drag begins.
  Start prepare(Objective& objective, int d) {
    d_ = d;
    drag_.clear();
    return minimizers_.prepare(objective, d);
  }

  /// Minimises from q (d), in place. If q is the last frame of a drag, it starts where the drag is
  /// extrapolated to. Elsewhere BFGS forgets its approximation, which holds near that frame: after
  /// a jump the Hessian at tau is the better start.
  Report minimize(Objective& objective, const double* inputs, Method method, double* q,
                  const Termination& stop) {
    if (drag_.ends_at(d_, q))
      drag_.extrapolate(d_, inputs, q);
    else if (hessian_is_expensive_)  // otherwise each BFGS starts from that Hessian anyway
      minimizers_.forget();
    const Report report = hessian_is_expensive_ && method == Method::bfgs
                              ? minimizers_.continue_bfgs(objective, q, stop)
                              : minimizers_.minimize(objective, method, q, stop);
    if (report.status == Status::converged)
      drag_.add(d_, inputs, q);
    else
      drag_.clear();
    return report;
  }

 private:
  bool hessian_is_expensive_;
  int d_ = 0;
  Minimizers minimizers_;
  DragExtrapolation drag_;
};

}  // namespace snapspace::online
