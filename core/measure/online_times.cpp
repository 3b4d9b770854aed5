#include "measure/online_times.h"

#include <vector>

#include "live/reconstruct.h"
#include "measure/shortest_time.h"

namespace snapspace {

EvaluationTimes time_evaluations(live::ReducedFunction& function, const double* q, int repeats) {
  volatile double sink = 0.0;
  const auto d = static_cast<std::size_t>(function.dimension());
  std::vector<double> gradient(d), hessian(d * d);
  EvaluationTimes times;
  times.value_and_gradient = shortest_time(
      repeats, [&] { sink = sink + function.value_and_gradient(q, gradient.data()); });
  times.derivatives = shortest_time(
      repeats, [&] { sink = sink + function.derivatives(q, gradient.data(), hessian.data()); });
  return times;
}

double time_reconstruct(std::size_t size, int dimension, const double* tau, const double* modes,
                        const double* q, int repeats) {
  volatile double sink = 0.0;
  std::vector<double> shape(size);
  return shortest_time(repeats, [&] {
    live::reconstruct(size, dimension, tau, modes, q, shape.data());
    sink = sink + shape[size / 2];
  });
}

}  // namespace snapspace
