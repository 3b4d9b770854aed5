#pragma once
#include <vector>

#include "cholesky/weighted_graph.h"

namespace snapspace {

/// Splits a graph into two sides of like weight without an edge from one to the other, and a light
/// separator between them: of a coarser graph first, if this one is large, then refined
/// [Hendrickson & Rothberg 1998; Karypis & Kumar 1998]. A side may be empty in small or dense
/// graphs.
[[nodiscard]] std::vector<Side> find_separator(const WeightedGraph& graph);

}  // namespace snapspace
