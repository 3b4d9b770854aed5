#include "mesh/sweep.h"

#include <algorithm>

namespace snapspace {

namespace {

/// About a dozen vertices come and go between two stops. All their vectors together take a part of
/// the first-level cache.
constexpr int kTetsPerStop = 64;

}  // namespace

std::vector<SweepStop> sweep_stops(const std::int32_t* corners, int tet_count, int vertex_count) {
  std::vector<SweepStop> stops((tet_count + kTetsPerStop - 1) / kTetsPerStop);
  if (stops.empty()) return {{0, vertex_count, vertex_count}};
  std::int32_t reached = 0;
  for (std::size_t k = 0; k < stops.size(); ++k) {
    const int begin = static_cast<int>(k) * kTetsPerStop;
    stops[k].tets = std::min(begin + kTetsPerStop, tet_count);
    for (int i = 4 * begin; i < 4 * stops[k].tets; ++i) reached = std::max(reached, corners[i] + 1);
    stops[k].reached = reached;
  }
  stops.back().reached = vertex_count;  // some vertices may be in no tet
  std::int32_t complete = vertex_count;
  for (std::size_t k = stops.size(); k-- > 0;) {
    stops[k].complete = std::min(complete, stops[k].reached);
    for (int i = 4 * static_cast<int>(k) * kTetsPerStop; i < 4 * stops[k].tets; ++i)
      complete = std::min(complete, corners[i]);
  }
  return stops;
}

}  // namespace snapspace
