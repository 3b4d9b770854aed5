#include "snapshots/warp.h"

#include <algorithm>
#include <vector>

#include "element/rest_shell.h"
#include "energy/rotation_strain.h"
#include "energy/shell_strain.h"
#include "memory/scratch.h"
#include "simd/lanes.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

constexpr int kSamples = 2 * kWideLanes;
using SamplePack = SingleLanes<kSamples>;
using SampleColumn = StreamedVector<SamplePack>;

/// Iterations with a multigrid cycle; the exact inverse needs only one.
constexpr int kCycles = 4;

/// The first `samples` rows of `width` numbers, one per lane.
std::vector<SamplePack> packed_rows(const double* rows, int width, int samples) {
  std::vector<SamplePack> packs(width, SamplePack(0));
  for (int lane = 0; lane < samples; ++lane)
    for (int i = 0; i < width; ++i) set_lane(packs[i], lane, rows[std::size_t(lane) * width + i]);
  return packs;
}

SampleColumn combined_responses(const LinearResponse& response,
                                const std::vector<SamplePack>& coordinates) {
  SampleColumn u(response.size(), SamplePack(0));
  for (std::size_t i = 0; i < u.size(); ++i)
    for (int k = 0; k < response.count(); ++k)
      u[i] += SamplePack(response.entry(i, k)) * coordinates[k];
  return u;
}

/// The same as in fill_residual for an element of a shell: the stress in place of P.
void shell_residual(const ElasticEnergy& energy, int element, const SamplePack (&linear)[3][3],
                    const SamplePack (&x)[3][3], SamplePack weight, SamplePack (&stress)[3][3]) {
  if (is_triangle(energy.rest.tets[element].vertices)) {
    triangle_rotation_strain(energy.rest_numbers(element), linear, stress);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) stress[r][c] = weight * (stress[r][c] - x[r][c]);
    return;
  }
  const HingeVector hinge(energy.rest_numbers(element) + 1);
  SamplePack wanted[3], reached[3];
  hinge.turned(linear, wanted);
  hinge.of(x, reached);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      stress[r][c] =
          weight * SamplePack(static_cast<float>(hinge.row[c])) * (wanted[r] - reached[r]);
}

/// Sets the residual, as forces in this unit, of the shape x with respect to the nearest shape.
void fill_residual(const PosingSystem& system, const std::vector<double>& stiffnesses, double unit,
                   const SampleColumn& linear, const std::vector<SamplePack>& targets,
                   const SampleColumn& x, SampleColumn& residual) {
  std::fill(residual.begin(), residual.end(), SamplePack(0));
  const RestShape& rest = system.energy.rest;
  for (std::size_t t = 0; t < rest.tets.size(); ++t) {
    const RestTetOf<float>& tet = rest.single_tets[t];
    const float volume = static_cast<float>(rest.tets[t].volume / unit);
    const SamplePack weight(static_cast<float>(stiffnesses[t]) * volume);
    SamplePack small[3][3], G[3][3], stress[3][3];
    displacement_gradient(tet, linear.data(), small);
    displacement_gradient(tet, x.data(), G);
    if (rest.shell) {
      shell_residual(system.energy, static_cast<int>(t), small, G, weight, stress);
    } else {
      rotation_strain(small, stress);
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) stress[r][c] = weight * (stress[r][c] - G[r][c]);
    }
    scatter_stress(tet, stress, residual.data());
  }
  for (std::size_t k = 0; k < system.pinned.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = 3 * static_cast<std::size_t>(system.pinned[k]) + c;
      residual[i] += SamplePack(static_cast<float>(2.0 * system.weights[k] / unit)) *
                     (targets[3 * k + c] - x[i]);
    }
}

}  // namespace

void warp(const PosingSystem& system, const LinearResponse& response, const double* coordinates,
          const double* inputs, int samples, double* displacements) {
  const std::size_t size = response.size();
  const int steps = system.inverse.kind() == InverseKind::cycle ? kCycles : 1;
  const std::vector<double> stiffnesses = system.energy.stiffnesses();
  const double unit = system.energy.force_unit();
  parallel_for((samples + kSamples - 1) / kSamples, 0, [&](int pack) {
    const FlushDenormals flush;
    const std::size_t first = std::size_t(pack) * kSamples;
    const int used = std::min(kSamples, samples - static_cast<int>(first));
    const SampleColumn linear = combined_responses(
        response, packed_rows(coordinates + first * response.count(), response.count(), used));
    const std::vector<SamplePack> targets =
        packed_rows(inputs + first * system.input_size(), system.input_size(), used);
    SampleColumn x(size, SamplePack(0)), residual(size, SamplePack(0));
    Scratch scratch;
    for (int step = 0; step < steps; ++step) {
      fill_residual(system, stiffnesses, unit, linear, targets, x, residual);
      system.inverse.apply(residual.data(), residual.data(), scratch);
      for (std::size_t i = 0; i < size; ++i)
        x[i] += SamplePack(static_cast<float>(unit)) * residual[i];
    }
    std::vector<double> shape(size);
    for (int lane = 0; lane < used; ++lane) {
      for (std::size_t i = 0; i < size; ++i) shape[i] = x[i][lane];
      system.numbering.to_external(shape.data(), displacements + (first + lane) * size);
    }
  });
}

}  // namespace snapspace
