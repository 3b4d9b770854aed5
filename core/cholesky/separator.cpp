#include "cholesky/separator.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "cholesky/separator_refinement.h"

namespace snapspace {

namespace {

using Indices = std::vector<std::int32_t>;

/// Pairs of neighbours along heavy edges, and (v, v) for the vertices that are left over.
std::vector<std::pair<std::int32_t, std::int32_t>> matching(const WeightedGraph& graph) {
  Indices sequence(graph.size());
  std::iota(sequence.begin(), sequence.end(), 0);
  // Vertices with few neighbours go first, as they have the least choice; otherwise separators get
  // 5 % larger.
  std::stable_sort(sequence.begin(), sequence.end(), [&](std::int32_t a, std::int32_t b) {
    return graph.around(a).size() < graph.around(b).size();
  });
  std::vector<std::pair<std::int32_t, std::int32_t>> pairs;
  std::vector<char> taken(graph.size());
  for (const std::int32_t v : sequence) {
    if (taken[v]) continue;
    std::int32_t mate = v, heaviest = 0;
    for (std::int32_t e = graph.first[v]; e < graph.first[v + 1]; ++e)
      if (!taken[graph.neighbours[e]] && graph.edge_weights[e] > heaviest) {
        mate = graph.neighbours[e];
        heaviest = graph.edge_weights[e];
      }
    taken[v] = taken[mate] = 1;
    pairs.emplace_back(v, mate);
  }
  return pairs;
}

/// The graph with each pair merged into one vertex. Sets `merged` to the new vertex of each old
/// one.
WeightedGraph coarsened(const WeightedGraph& graph, Indices& merged) {
  const auto pairs = matching(graph);
  merged.resize(graph.size());
  for (std::size_t c = 0; c < pairs.size(); ++c)
    merged[pairs[c].first] = merged[pairs[c].second] = static_cast<std::int32_t>(c);
  WeightedGraph result;
  Indices place(pairs.size(), -1);  // of the current vertex's edge to another, if it has one
  for (const auto& [v, mate] : pairs) {
    const std::int32_t begin = result.first.back();
    result.weights.push_back(0);
    const auto add = [&](std::int32_t member) {
      result.weights.back() += graph.weights[member];
      for (std::int32_t e = graph.first[member]; e < graph.first[member + 1]; ++e) {
        const std::int32_t to = merged[graph.neighbours[e]];
        if (to == merged[v]) continue;
        if (place[to] < begin) {
          place[to] = static_cast<std::int32_t>(result.neighbours.size());
          result.neighbours.push_back(to);
          result.edge_weights.push_back(0);
        }
        result.edge_weights[place[to]] += graph.edge_weights[e];
      }
    };
    add(v);
    if (mate != v) add(mate);
    result.first.push_back(static_cast<std::int32_t>(result.neighbours.size()));
  }
  return result;
}

/// Grows one side from a vertex, breadth first, until it has half of the weight.
std::vector<Side> grown(const WeightedGraph& graph, std::int32_t start) {
  std::vector<Side> sides(graph.size(), Side::right);
  const auto total = std::accumulate(graph.weights.begin(), graph.weights.end(), std::int64_t{0});
  std::int64_t reached = 0;
  Indices front;
  const auto see = [&](std::int32_t v) {
    if (std::exchange(sides[v], Side::left) == Side::right) front.push_back(v);
  };
  see(start);
  std::size_t head = 0;
  for (std::int32_t next = 0; 2 * reached < total; ++head) {
    while (head == front.size()) see(next++);  // in another component
    reached += graph.weights[front[head]];
    for (const std::int32_t u : graph.around(front[head])) see(u);
  }
  // vertices that were seen but not reached separate the sides
  for (; head < front.size(); ++head) sides[front[head]] = Side::separator;
  return sides;
}

/// The lightest of the separators that grow from a few vertices.
std::vector<Side> best_grown(const WeightedGraph& graph) {
  constexpr std::int64_t kStarts = 2;
  std::vector<Side> best;
  double least = 0.0;
  for (std::int64_t k = 0; k < kStarts; ++k) {
    auto sides = grown(graph, static_cast<std::int32_t>(k * graph.size() / kStarts));
    const double cost = refine_separator(graph, sides);
    if (best.empty() || cost < least) {
      least = cost;
      best = std::move(sides);
    }
  }
  return best;
}

}  // namespace

std::vector<Side> find_separator(const WeightedGraph& graph) {
  constexpr std::int32_t kCoarsest = 100;
  constexpr double kMinReduction = 0.95;  // graphs like stars have few pairs
  if (graph.size() <= kCoarsest) return best_grown(graph);
  Indices merged;
  const WeightedGraph coarse = coarsened(graph, merged);
  if (coarse.size() > kMinReduction * graph.size()) return best_grown(graph);
  const std::vector<Side> coarse_sides = find_separator(coarse);
  std::vector<Side> sides;
  sides.reserve(merged.size());
  for (const std::int32_t c : merged) sides.push_back(coarse_sides[c]);
  refine_separator(graph, sides);
  return sides;
}

}  // namespace snapspace
