#pragma once
#include <vector>

#include "cholesky/weighted_graph.h"

namespace snapspace {

/// Moves vertices out of a separator as long as that makes it lighter [Fiduccia & Mattheyses 1982;
/// Ashcraft & Liu 1996]. A moved vertex's neighbours on the other side enter the separator. Returns
/// the cost: the weight of the separator, times up to 1.5 where the sides are uneven.
double refine_separator(const WeightedGraph& graph, std::vector<Side>& sides);

}  // namespace snapspace
