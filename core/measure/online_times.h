#pragma once
#include <cstddef>
#include <vector>

#include "measure/machine_peak.h"
#include "online/quartic.h"
#include "online/reconstruct.h"

namespace snapspace {

/// Shortest seconds of an evaluation of a quartic, without the cost of a call from Python.
struct QuarticTimes {
  double value_and_gradient = 0.0;
  double derivatives = 0.0;  ///< value, gradient and Hessian
};

[[nodiscard]] inline QuarticTimes time_quartic(online::Quartic& quartic, const double* q,
                                               int repeats, volatile double& sink) {
  const auto d = static_cast<std::size_t>(quartic.dimension());
  std::vector<double> gradient(d), hessian(d * d);
  QuarticTimes times;
  times.value_and_gradient =
      shortest_time(repeats, [&] { sink = sink + quartic.value_and_gradient(q, gradient.data()); });
  times.derivatives = shortest_time(
      repeats, [&] { sink = sink + quartic.derivatives(q, gradient.data(), hessian.data()); });
  return times;
}

/// Shortest seconds of tau + U q.
[[nodiscard]] inline double time_reconstruct(std::size_t size, int dimension, const double* tau,
                                             const double* modes, const double* q, int repeats,
                                             volatile double& sink) {
  std::vector<double> shape(size);
  return shortest_time(repeats, [&] {
    online::reconstruct(size, dimension, tau, modes, q, shape.data());
    sink = sink + shape[size / 2];
  });
}

}  // namespace snapspace
