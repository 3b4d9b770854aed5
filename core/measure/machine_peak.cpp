#include "measure/machine_peak.h"

#include <vector>

#include "measure/shortest_time.h"
#include "simd/lanes.h"

namespace snapspace {

namespace {

/// @param sink  keeps the compiler from removing the work
template <class Real>
double peak_flops_of(int repeats, volatile double& sink) {
  constexpr int kChains = 12, kSteps = 200'000;
  Real sums[kChains];
  for (int i = 0; i < kChains; ++i) sums[i] = Real(static_cast<typename Real::Scalar>(i));
  // factors unknown to the compiler
  Real factor(static_cast<typename Real::Scalar>(sink)), shift(factor);
  const double seconds = shortest_time(repeats, [&] {
    for (int step = 0; step < kSteps; ++step)
      for (Real& sum : sums) sum = sum * factor + shift;
  });
  for (const Real& sum : sums) sink = sink + static_cast<double>(sum[0]);
  return 2.0 * kChains * kSteps * Real::kWidth / seconds;
}

}  // namespace

double peak_flops(bool single, int repeats) {
  volatile double sink = 1.0 - 1e-9;
  return single ? peak_flops_of<SingleLanes<2 * kWideLanes>>(repeats, sink)
                : peak_flops_of<Lanes<kWideLanes>>(repeats, sink);
}

double read_bandwidth(std::size_t bytes, int repeats) {
  volatile double sink = 0.0;
  using Real = Lanes<kWideLanes>;
  const std::vector<Real> data(bytes / sizeof(Real), Real(1.0));
  // volatile, so the compiler cannot assume that nothing has changed
  const Real* volatile source = data.data();
  const double seconds = shortest_time(repeats, [&] {
    const Real* from = source;
    Real sums[8];
    for (Real& sum : sums) sum = Real(0.0);
    for (std::size_t i = 0; i + 8 <= data.size(); i += 8)
      for (int k = 0; k < 8; ++k) sums[k] += from[i + k];
    for (const Real& sum : sums) sink = sink + sum[0];
  });
  return static_cast<double>(data.size() * sizeof(Real)) / seconds;
}

}  // namespace snapspace
