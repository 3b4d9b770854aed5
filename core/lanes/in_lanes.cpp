#include "lanes/in_lanes.h"

#include <utility>
#include <vector>

#include "memory/scratch.h"
#include "threads/flush_denormals.h"

namespace snapspace {

namespace {

using Wide = Lanes<kWideLanes>;
using SingleWide = SingleLanes<2 * kWideLanes>;

double lane_of(double x, int) { return x; }
template <class T, int Width>
double lane_of(Pack<T, Width> x, int lane) {
  return x[lane];
}

/// Vectors (count x size) as one vector of packs. Unused lanes are zero.
template <class Real>
std::vector<Real> packed(std::size_t count, std::size_t size, const double* vectors) {
  std::vector<Real> result(size, Real(0));
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < size; ++i)
      set_lane(result[i], static_cast<int>(k), vectors[k * size + i]);
  return result;
}

template <class Real>
void unpack(const std::vector<Real>& from, std::size_t count, double* vectors) {
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < from.size(); ++i)
      vectors[k * from.size() + i] = lane_of(from[i], static_cast<int>(k));
}

/// Calls act with a default value of the type that a packing stands for.
template <class Act>
void with_packs(Packing packing, Act act) {
  if (packing == Packing::alone) act(double());
  if (packing == Packing::lanes) act(Wide());
  if (packing == Packing::single_lanes) act(SingleWide());
}

/// @param solve  function of 3n packs, solves in place
template <class Solve>
void in_lanes(Packing packing, std::size_t count, std::size_t size, const double* right_hand_sides,
              double* solutions, Solve solve) {
  const FlushDenormals flush;
  with_packs(packing, [&]<class Real>(Real) {
    std::vector<Real> vector = packed<Real>(count, size, right_hand_sides);
    solve(vector.data());
    unpack(vector, count, solutions);
  });
}

template <class Real>
void add_energies(const ElasticEnergy& energy, std::size_t count, const double* shapes,
                  double* values, double* gradients) {
  const std::size_t size = 3 * static_cast<std::size_t>(energy.rest.vertex_count);
  const std::vector<Real> u = packed<Real>(count, size, shapes);
  std::vector<Real> gradient(size, Real(0));
  const Sum<Real> sums = energy.value_and_gradient(u.data(), gradient.data());
  for (std::size_t k = 0; k < count; ++k) values[k] = sums[static_cast<int>(k)];
  unpack(gradient, count, gradients);
}

}  // namespace

int samples_together(Packing packing) {
  if (packing == Packing::alone) return 1;
  return packing == Packing::lanes ? Wide::kWidth : SingleWide::kWidth;
}

void solve_in_lanes(const ScalarFactor& factor, Packing packing, std::size_t count,
                    const double* right_hand_sides, double* solutions) {
  in_lanes(packing, count, 3 * factor.size(), right_hand_sides, solutions,
           [&](auto* vector) { (void)factor.solve(vector, vector); });
}

void apply_in_lanes(const TwoGridCycle& cycle, Packing packing, std::size_t count,
                    const double* right_hand_sides, double* products) {
  Scratch scratch;
  in_lanes(packing, count, 3 * cycle.size(), right_hand_sides, products,
           [&](auto* vector) { (void)cycle.apply(vector, vector, scratch); });
}

void energies_in_lanes(const ElasticEnergy& energy, Packing packing, std::size_t count,
                       const double* shapes, double* values, double* gradients) {
  if (packing == Packing::single_lanes)
    add_energies<SingleWide>(energy, count, shapes, values, gradients);
  else
    add_energies<Wide>(energy, count, shapes, values, gradients);
}

}  // namespace snapspace
