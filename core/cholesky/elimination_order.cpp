#include "cholesky/elimination_order.h"

#include <Eigen/OrderingMethods>
#include <utility>

#include "cholesky/separator.h"

namespace snapspace {

namespace {

using Indices = std::vector<std::int32_t>;

constexpr std::int32_t kLeaf = 400;

WeightedGraph subgraph(const WeightedGraph& graph, const Indices& vertices, Indices& local) {
  for (std::size_t i = 0; i < vertices.size(); ++i)
    local[vertices[i]] = static_cast<std::int32_t>(i);
  WeightedGraph result;
  for (const std::int32_t v : vertices) {
    for (std::int32_t e = graph.first[v]; e < graph.first[v + 1]; ++e)
      if (local[graph.neighbours[e]] >= 0) result.neighbours.push_back(local[graph.neighbours[e]]);
    result.first.push_back(static_cast<std::int32_t>(result.neighbours.size()));
  }
  result.weights.assign(vertices.size(), 1);
  result.edge_weights.assign(result.neighbours.size(), 1);
  for (const std::int32_t v : vertices) local[v] = -1;
  return result;
}

Indices leaf_order(const WeightedGraph& graph) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::int32_t v = 0; v < graph.size(); ++v) {
    entries.emplace_back(v, v, 1.0);
    for (std::int32_t e = graph.first[v]; e < graph.first[v + 1]; ++e)
      entries.emplace_back(graph.neighbours[e], v, 1.0);
  }
  Eigen::SparseMatrix<double> A(graph.size(), graph.size());
  A.setFromTriplets(entries.begin(), entries.end());
  return minimum_degree(A);
}

/// Appends the vertices of `graph` (whose names are in `vertices`).
void dissect(const WeightedGraph& graph, const Indices& vertices, Indices& order) {
  if (graph.size() <= (getenv("LEAF") ? atoi(getenv("LEAF")) : kLeaf)) {
    for (const std::int32_t v : leaf_order(graph)) order.push_back(vertices[v]);
    return;
  }
  const std::vector<Side> sides = find_separator(graph);
  Indices local(graph.size(), -1);
  for (const Side side : {Side::left, Side::right}) {
    Indices part, names;
    for (std::int32_t v = 0; v < graph.size(); ++v)
      if (sides[v] == side) {
        part.push_back(v);
        names.push_back(vertices[v]);
      }
    if (!part.empty()) dissect(subgraph(graph, part, local), names, order);
  }
  for (std::int32_t v = 0; v < graph.size(); ++v)
    if (sides[v] == Side::separator) order.push_back(vertices[v]);
}

}  // namespace

Indices minimum_degree(const Eigen::SparseMatrix<double>& A) {
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, std::int32_t> order;
  Eigen::AMDOrdering<std::int32_t>()(A.selfadjointView<Eigen::Lower>(), order);
  return {order.indices().begin(), order.indices().end()};
}

Indices nested_dissection(const Eigen::SparseMatrix<double>& A) {
  WeightedGraph graph;
  Indices all(A.rows());
  for (std::int32_t v = 0; v < A.rows(); ++v) {
    all[v] = v;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(A, v); entry; ++entry)
      if (entry.row() != v) graph.neighbours.push_back(static_cast<std::int32_t>(entry.row()));
    graph.first.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
  }
  graph.weights.assign(A.rows(), 1);
  graph.edge_weights.assign(graph.neighbours.size(), 1);
  Indices order;
  order.reserve(A.rows());
  dissect(graph, all, order);
  return order;
}

Indices elimination_order(const Eigen::SparseMatrix<double>& A) { return nested_dissection(A); }

}  // namespace snapspace
