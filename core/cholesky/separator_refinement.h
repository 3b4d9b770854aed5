#pragma once
#include <vector>

#include "cholesky/weighted_graph.h"

namespace snapspace {

/// Moves vertices out of a separator as long as that makes it lighter [Fiduccia & Mattheyses 1982;
/// Ashcraft & Liu 1996]. The neighbours of a moved vertex on the other side come in for it. Returns
/// the cost: the weight of the separator, up to half as much again where the sides are uneven.
double refine_separator(const WeightedGraph& graph, std::vector<Side>& sides);

}  // namespace snapspace
