#include "measure/solver_parts.h"

#include "measure/shortest_time.h"
#include "snapshots/lane_objectives.h"
#include "threads/flush_denormals.h"

namespace snapspace {

namespace {

/// Sums and products of an element's St.VK energy and gradient for one sample: differences of nodal
/// values 9, their gradient 45, strain 42, stress and energy 25, first stress 54, forces 45,
/// scattering 18.
constexpr double kKernelFlopsPerTet = 238.0;

template <class Real>
PartTimes times_of(const PosingSystem& system, const std::vector<double>& shape, int repeats) {
  const FlushDenormals flush;
  using Single = SingleLanes<Real::kWidth>;
  const std::size_t size = shape.size();
  std::vector<Real> u(size), gradient(size);
  for (std::size_t i = 0; i < size; ++i) u[i] = Real(static_cast<typename Real::Scalar>(shape[i]));
  std::vector<Single> vector(size, Single(1.0f));
  const LaneObjectives objectives = system.lanes();
  const auto objective = objectives.objective<Real>(kOneThread);
  SweepVisitor idle;
  PartTimes times;
  times.kernel_seconds = shortest_time(
      repeats, [&] { (void)objective->value_and_gradient(u.data(), gradient.data(), idle); });
  times.solve_seconds = shortest_time(repeats, [&] {
    std::fill(vector.begin(), vector.end(), Single(1.0f));
    objective->precondition(vector.data(), vector.data());
  });
  times.kernel_flops =
      kKernelFlopsPerTet * static_cast<double>(system.energy.rest.tets.size()) * Real::kWidth;
  // one product and one sum each, per component and lane
  times.solve_flops = 6.0 * static_cast<double>(system.inverse.products()) * Real::kWidth;
  return times;
}

}  // namespace

PartTimes time_parts(const PosingSystem& system, const std::vector<double>& shape, bool single,
                     int repeats) {
  return single ? times_of<SingleLanes<2 * kWideLanes>>(system, shape, repeats)
                : times_of<Lanes<kWideLanes>>(system, shape, repeats);
}

}  // namespace snapspace
