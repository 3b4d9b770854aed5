#pragma once
#include <cstddef>

#include "cholesky/scalar_factor.h"
#include "energy/elastic_energy.h"
#include "multigrid/two_grid_cycle.h"

/// What works on one sample per lane, for callers that have plain arrays and know no packs.
namespace snapspace {

/// One sample alone, or as many as the widest pack has lanes, in double or single precision.
enum class Packing { alone, lanes, single_lanes };

/// How many samples go together at most.
[[nodiscard]] int samples_together(Packing packing);

/// Solutions for right-hand sides, count x 3n both.
void solve_in_lanes(const ScalarFactor& factor, Packing packing, std::size_t count,
                    const double* right_hand_sides, double* solutions);

/// The cycle times right-hand sides, count x 3n both.
void apply_in_lanes(const TwoGridCycle& cycle, Packing packing, std::size_t count,
                    const double* right_hand_sides, double* products);

/// Energies (count) and gradients (count x 3n) at displacements (count x 3n); not alone.
void energies_in_lanes(const ElasticEnergy& energy, Packing packing, std::size_t count,
                       const double* shapes, double* values, double* gradients);

}  // namespace snapspace
