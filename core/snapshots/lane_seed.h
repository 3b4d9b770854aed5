#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "snapshots/lane.h"
#include "snapshots/lane_objective.h"

namespace snapspace {

/// A lane of an array of packs.
template <class Packs>
std::vector<double> lane_of(const Packs& packs, int lane) {
  std::vector<double> result(packs.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = packs[i][lane];
  return result;
}

/// Gives a lane the seed near a shape, if its objective has one for each sample.
template <class Real>
void set_seed(LaneObjective<Real>& objective, int index, Lane& lane,
              const std::vector<double>& shape) {
  lane.seed = objective.seed_near(lane.sample->input.data(), shape.data());
  objective.load_seed(index, lane.seed);
  lane.path = 0.0;
  lane.next_seed = std::max(Lane::kFirstRenewal, 2 * lane.iterations);
}

}  // namespace snapspace
