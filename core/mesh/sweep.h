#pragma once
#include <cstdint>
#include <vector>

namespace snapspace {

/// Where a pass over the tets may pause for other work on the vertices: soon after the pass the
/// vertices are still in a cache.
struct SweepStop {
  std::int32_t tets;      ///< tets before this one are done
  std::int32_t reached;   ///< only vertices before this one were needed so far
  std::int32_t complete;  ///< vertices before this one are in no other tet
};

/// Stops after every few tets, for tets in any order. The last stop is past all tets and vertices.
/// @param corners  4 vertices per tet
[[nodiscard]] std::vector<SweepStop> sweep_stops(const std::int32_t* corners, int tet_count,
                                                 int vertex_count);

/// Work that is done on the vertices during a pass: `before` is called when the vertices from
/// `begin` to before `end` are needed next, `after` when they are complete. Ranges follow each
/// other from 0 on. This base class does nothing.
struct SweepVisitor {
  virtual ~SweepVisitor() = default;
  virtual void before(int /*begin*/, int /*end*/) {}
  virtual void after(int /*begin*/, int /*end*/) {}
};

}  // namespace snapspace
