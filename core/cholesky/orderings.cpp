#include "cholesky/orderings.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <numeric>

#include "cholesky/separator.h"

namespace snapspace {

namespace {

using Indices = std::vector<std::int32_t>;
using Pattern = Eigen::SparseMatrix<double>;

/// The subgraph induced by some vertices. `local` must be -1 everywhere, and is so again
/// afterwards.
WeightedGraph induced(const WeightedGraph& graph, const Indices& vertices, Indices& local) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    local[vertices[i]] = static_cast<std::int32_t>(i);
  WeightedGraph result;
  for (const std::int32_t v : vertices) {
    for (const std::int32_t u : graph.around(v))
      if (local[u] >= 0) result.neighbours.push_back(local[u]);
    result.first.push_back(static_cast<std::int32_t>(result.neighbours.size()));
  }
  for (const std::int32_t v : vertices) local[v] = -1;
  result.weights.assign(vertices.size(), 1);
  result.edge_weights.assign(result.neighbours.size(), 1);
  return result;
}

Indices leaf_order(const WeightedGraph& graph) {
  Pattern A(graph.size(), graph.size());
  A.reserve(graph.size() + static_cast<Eigen::Index>(graph.neighbours.size()));
  for (std::int32_t v = 0; v < graph.size(); ++v) {
    Indices rows(graph.around(v).begin(), graph.around(v).end());
    rows.push_back(v);
    std::sort(rows.begin(), rows.end());
    A.startVec(v);
    for (const std::int32_t row : rows) A.insertBack(row, v) = 1.0;
  }
  A.finalize();
  return minimum_degree(A);
}

/// Appends an order of the graph's vertices, which the caller calls `names`.
void dissect(const WeightedGraph& graph, const Indices& names, Indices& order) {
  constexpr std::int32_t kLeaf = 24;
  const auto append = [&](const Indices& vertices) {
    for (const std::int32_t v : vertices) order.push_back(names[v]);
  };
  if (graph.size() <= kLeaf) return append(leaf_order(graph));
  const std::vector<Side> sides = find_separator(graph);
  Indices parts[3];
  for (std::int32_t v = 0; v < graph.size(); ++v) parts[static_cast<int>(sides[v])].push_back(v);
  Indices local(graph.size(), -1);
  for (int side = 0; side < 2; ++side) {
    if (parts[side].empty()) continue;
    const WeightedGraph within = induced(graph, parts[side], local);
    // without a separator, dissection gains nothing
    if (within.size() == graph.size()) return append(leaf_order(graph));
    Indices own;
    for (const std::int32_t v : parts[side]) own.push_back(names[v]);
    dissect(within, own, order);
  }
  append(parts[2]);
}

}  // namespace

Indices minimum_degree(const Pattern& A) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, std::int32_t> order;
  Eigen::AMDOrdering<std::int32_t>()(A.selfadjointView<Eigen::Lower>(), order);
  return {order.indices().begin(), order.indices().end()};
}

Indices nested_dissection(const Pattern& A) {
  WeightedGraph graph;
  for (Eigen::Index v = 0; v < A.cols(); ++v) {
    for (Pattern::InnerIterator entry(A, v); entry; ++entry)
      if (entry.row() != v) graph.neighbours.push_back(static_cast<std::int32_t>(entry.row()));
    graph.first.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
  }
  graph.weights.assign(A.cols(), 1);
  graph.edge_weights.assign(graph.neighbours.size(), 1);
  Indices names(A.cols()), order;
  std::iota(names.begin(), names.end(), 0);
  order.reserve(names.size());
  dissect(graph, names, order);
  return order;
}

}  // namespace snapspace
