#pragma once
#include <cstdint>
#include <vector>

namespace snapspace {

/// Where a pass over the tets may pause for those who have work to do on the vertices: the nearer
/// to the pass, the likelier the vertices are still in a cache.
struct SweepStop {
  std::int32_t tets;      ///< tets before this one are done
  std::int32_t reached;   ///< only vertices before this one were needed for them
  std::int32_t complete;  ///< vertices before this one are in no other tet
};

/// Stops after every few tets, for tets in any order; the last one is behind all tets and vertices.
/// @param corners  4 vertices per tet
[[nodiscard]] std::vector<SweepStop> sweep_stops(const std::int32_t* corners, int tet_count,
                                                 int vertex_count);

/// Who has work to do during a pass: told that the vertices from `begin` to before `end` are needed
/// next, or are complete. Ranges follow each other from 0 on. This one has nothing to do.
struct SweepVisitor {
  virtual ~SweepVisitor() = default;
  virtual void before(int /*begin*/, int /*end*/) {}
  virtual void after(int /*begin*/, int /*end*/) {}
};

}  // namespace snapspace
