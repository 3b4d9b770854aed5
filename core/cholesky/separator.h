#pragma once
#include <vector>

#include "cholesky/weighted_graph.h"

namespace snapspace {

/// Splits a graph into two sides of similar weight without an edge between them, and a light
/// separator. A large graph is coarsened, split, and the separator refined [Hendrickson & Rothberg
/// 1998; Karypis & Kumar 1998]. A side may be empty in small or dense graphs.
[[nodiscard]] std::vector<Side> find_separator(const WeightedGraph& graph);

}  // namespace snapspace
