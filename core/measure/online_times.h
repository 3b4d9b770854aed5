#pragma once
#include <cstddef>

#include "live/live_loop.h"

namespace snapspace {

/// Shortest time of an evaluation in seconds, without the cost of a call from Python.
struct EvaluationTimes {
  double value_and_gradient = 0.0;
  double derivatives = 0.0;  ///< value, gradient and Hessian
};

[[nodiscard]] EvaluationTimes time_evaluations(live::ReducedFunction& function, const double* q,
                                               int repeats);

/// Shortest time of tau + U q in seconds.
[[nodiscard]] double time_reconstruct(std::size_t size, int dimension, const double* tau,
                                      const double* modes, const double* q, int repeats);

}  // namespace snapspace
