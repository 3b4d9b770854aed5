#include "snapshots/warp.h"

#include <algorithm>
#include <vector>

#include "energy/rotation_strain.h"
#include "memory/scratch.h"
#include "simd/lanes.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

constexpr int kLanes = 2 * kWideLanes;
using Real = SingleLanes<kLanes>;
using Column = StreamedVector<Real>;

/// Of the cycle; an inverse needs one.
constexpr int kCycles = 4;

/// `samples` rows of `width` numbers, from the first on, as lanes.
std::vector<Real> in_lanes(const double* rows, int width, int samples) {
  std::vector<Real> packs(width, Real(0));
  for (int lane = 0; lane < samples; ++lane)
    for (int i = 0; i < width; ++i) set_lane(packs[i], lane, rows[std::size_t(lane) * width + i]);
  return packs;
}

Column combined(const LinearResponse& response, const std::vector<Real>& coordinates) {
  Column u(response.size(), Real(0));
  for (std::size_t i = 0; i < u.size(); ++i)
    for (int k = 0; k < response.count(); ++k) u[i] += Real(response.entry(i, k)) * coordinates[k];
  return u;
}

/// How far the shape x is from the nearest one, as forces.
void fill_residual(const PosingSystem& system, const std::vector<float>& stiffnesses,
                   const Column& linear, const std::vector<Real>& targets, const Column& x,
                   Column& residual) {
  std::fill(residual.begin(), residual.end(), Real(0));
  const float* stiffness = stiffnesses.data();
  for (const RestTetOf<float>& tet : system.energy.rest.single_tets) {
    const Real weight(*stiffness++ * tet.volume);
    Real G[3][3], wanted[3][3];
    displacement_gradient(tet, linear.data(), G);
    rotation_strain(G, wanted);
    displacement_gradient(tet, x.data(), G);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) wanted[r][c] = weight * (wanted[r][c] - G[r][c]);
    scatter_stress(tet, wanted, residual.data());
  }
  for (std::size_t k = 0; k < system.pinned.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = 3 * static_cast<std::size_t>(system.pinned[k]) + c;
      residual[i] +=
          Real(static_cast<float>(2.0 * system.weights[k])) * (targets[3 * k + c] - x[i]);
    }
}

}  // namespace

void warp(const PosingSystem& system, const LinearResponse& response, const double* coordinates,
          const double* inputs, int samples, double* displacements) {
  const std::size_t size = response.size();
  const int steps = system.inverse.kind() == InverseKind::cycle ? kCycles : 1;
  const std::vector<double> wide = system.energy.stiffnesses();
  const std::vector<float> stiffnesses(wide.begin(), wide.end());
  parallel_for((samples + kLanes - 1) / kLanes, 0, [&](int pack) {
    const FlushDenormals flush;
    const std::size_t first = std::size_t(pack) * kLanes;
    const int used = std::min(kLanes, samples - static_cast<int>(first));
    const Column linear = combined(
        response, in_lanes(coordinates + first * response.count(), response.count(), used));
    const std::vector<Real> targets =
        in_lanes(inputs + first * system.input_size(), system.input_size(), used);
    Column x(size, Real(0)), residual(size, Real(0));
    Scratch scratch;
    for (int step = 0; step < steps; ++step) {
      fill_residual(system, stiffnesses, linear, targets, x, residual);
      system.inverse.apply(residual.data(), residual.data(), scratch);
      for (std::size_t i = 0; i < size; ++i) x[i] += residual[i];
    }
    std::vector<double> shape(size);
    for (int lane = 0; lane < used; ++lane) {
      for (std::size_t i = 0; i < size; ++i) shape[i] = x[i][lane];
      system.numbering.to_external(shape.data(), displacements + (first + lane) * size);
    }
  });
}

}  // namespace snapspace
