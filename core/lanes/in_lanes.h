#pragma once
#include <cstddef>

#include "cholesky/scalar_factor.h"
#include "energy/elastic_energy.h"
#include "multigrid/two_grid_cycle.h"

/// Functions that work on one sample per lane, for callers that have plain arrays and no packs.
namespace snapspace {

/// One sample alone, or as many as the widest pack has lanes, in double or single precision.
enum class Packing { alone, lanes, single_lanes };

/// The largest number of samples that are computed together.
[[nodiscard]] int samples_together(Packing packing);

/// Solutions for right-hand sides; both are count x 3n.
void solve_in_lanes(const ScalarFactor& factor, Packing packing, std::size_t count,
                    const double* right_hand_sides, double* solutions);

/// The cycle times right-hand sides; both are count x 3n.
void apply_in_lanes(const TwoGridCycle& cycle, Packing packing, std::size_t count,
                    const double* right_hand_sides, double* products);

/// Energies (count) and gradients (count x 3n) at displacements (count x 3n). Packing::alone counts
/// as Packing::lanes.
void energies_in_lanes(const ElasticEnergy& energy, Packing packing, std::size_t count,
                       const double* shapes, double* values, double* gradients);

}  // namespace snapspace
