#include "cholesky/separator.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace snapspace {

namespace {

static const double BA = getenv("BA") ? atof(getenv("BA")) : 0.5;
using Indices = std::vector<std::int32_t>;

/// Merges pairs of vertices along heavy edges; `coarse` becomes the merged vertex of every one.
WeightedGraph coarsened(const WeightedGraph& graph, Indices& coarse) {
  coarse.assign(graph.size(), -1);
  Indices members;  // pairs; a single vertex is there twice
  members.reserve(graph.size() + graph.size() / 4);
  static const int MODE = getenv("MODE") ? atoi(getenv("MODE")) : 0;
  Indices seq(graph.size());
  for (std::int32_t v = 0; v < graph.size(); ++v) seq[v] = v;
  if (MODE & 1) {
    unsigned x = 12345;
    for (int i = graph.size() - 1; i > 0; --i) {
      x = x * 1664525u + 1013904223u;
      std::swap(seq[i], seq[(x >> 8) % (i + 1)]);
    }
  }
  if (MODE & 2)
    std::stable_sort(seq.begin(), seq.end(), [&](int a, int b) {
      return graph.first[a + 1] - graph.first[a] < graph.first[b + 1] - graph.first[b];
    });
  long tot = 0;
  for (int w : graph.weights) tot += w;
  long maxw = MODE & 8 ? std::max<long>(2, 1.5 * tot / 100) : 1L << 40;
  for (const std::int32_t v : seq) {
    if (coarse[v] >= 0) continue;
    std::int32_t mate = v;
    double heaviest = 0;
    for (std::int32_t e = graph.first[v]; e < graph.first[v + 1]; ++e)
      if (double w = MODE & 4 ? (double)graph.edge_weights[e] / graph.weights[graph.neighbours[e]]
                     : MODE & 16 ? (double)graph.edge_weights[e] * graph.edge_weights[e] /
                                       graph.weights[graph.neighbours[e]]
                                 : graph.edge_weights[e];
          w > heaviest && coarse[graph.neighbours[e]] < 0 &&
          graph.weights[v] + graph.weights[graph.neighbours[e]] <= maxw) {
        heaviest = w;
        mate = graph.neighbours[e];
      }
    coarse[v] = coarse[mate] = static_cast<std::int32_t>(members.size() / 2);
    members.insert(members.end(), {v, mate});
  }
  WeightedGraph result;
  Indices slot(members.size() / 2, -1);  // of the edge to a vertex, if it belongs to this one
  for (std::size_t c = 0; c < slot.size(); ++c) {
    const std::int32_t begin = result.first.back();
    std::int32_t weight = 0;
    for (std::size_t m = 2 * c; m < 2 * c + (members[2 * c] == members[2 * c + 1] ? 1 : 2); ++m) {
      weight += graph.weights[members[m]];
      for (std::int32_t e = graph.first[members[m]]; e < graph.first[members[m] + 1]; ++e) {
        const std::int32_t u = coarse[graph.neighbours[e]];
        if (u == static_cast<std::int32_t>(c)) continue;
        if (slot[u] < begin) {
          slot[u] = static_cast<std::int32_t>(result.neighbours.size());
          result.neighbours.push_back(u);
          result.edge_weights.push_back(0);
        }
        result.edge_weights[slot[u]] += graph.edge_weights[e];
      }
    }
    result.weights.push_back(weight);
    result.first.push_back(static_cast<std::int32_t>(result.neighbours.size()));
  }
  return result;
}

/// Moves vertices out of the separator to the sides as long as that makes it lighter
/// [Fiduccia & Mattheyses 1982].
class Refinement {
 public:
  Refinement(const WeightedGraph& graph, std::vector<Side>& sides)
      : graph_(graph), sides_(sides), moved_(graph.size()) {
    for (auto& gain : gains_) gain.resize(graph.size());
    for (std::int32_t v = 0; v < graph.size(); ++v)
      weights_[static_cast<int>(sides[v])] += graph.weights[v];
    static const double MO = getenv("MO") ? atof(getenv("MO")) : 0.6;
    most_ = (std::int64_t)(MO * (weights_[0] + weights_[1] + weights_[2]));
  }

  /// Weight of the separator, more where the sides are uneven.
  [[nodiscard]] double cost() const {
    const auto left = static_cast<double>(weights_[0]), right = static_cast<double>(weights_[1]);
    const double uneven = (left - right) / std::max(1.0, left + right);
    return static_cast<double>(weights_[2]) * (1.0 + BA * uneven * uneven);
  }

  void run() {
    constexpr int kMaxPasses = 8;
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const double before = cost();
      run_pass();
      if (!(cost() < before)) break;
    }
  }

 private:
  struct Move {
    std::int32_t vertex;
    int side;
    std::size_t pulled;  // where the vertices begin that it pulled into the separator
  };

  void put(std::int32_t v, Side side) {
    weights_[static_cast<int>(sides_[v])] -= graph_.weights[v];
    weights_[static_cast<int>(side)] += graph_.weights[v];
    sides_[v] = side;
  }

  void change_gain(std::int32_t v, int side, std::int32_t change) {
    gains_[side][v] += change;
    if (!moved_[v]) queues_[side].push({gains_[side][v], v});
  }

  /// Gains of a vertex that is in the separator from now on: its own weight, less that of the
  /// neighbours that its move would pull in.
  void enter(std::int32_t v) {
    std::int32_t pulled[2] = {};
    for (std::int32_t e = graph_.first[v]; e < graph_.first[v + 1]; ++e) {
      const std::int32_t u = graph_.neighbours[e];
      if (sides_[u] != Side::separator) pulled[sides_[u] == Side::left] += graph_.weights[u];
    }
    for (int side = 0; side < 2; ++side) {
      gains_[side][v] = 0;
      change_gain(v, side, graph_.weights[v] - pulled[side]);
    }
  }

  /// The vertex with the best gain that may still move to the side, or -1.
  std::int32_t best(int side) {
    auto& queue = queues_[side];
    for (; !queue.empty(); queue.pop()) {
      const auto [gain, v] = queue.top();
      if (!moved_[v] && sides_[v] == Side::separator && gains_[side][v] == gain &&
          weights_[side] + graph_.weights[v] <= most_)
        return v;
    }
    return -1;
  }

  void move(std::int32_t v, int side) {
    const Side other = static_cast<Side>(1 - side);
    const std::size_t pulled = pulled_.size();
    moves_.push_back({v, side, pulled});
    moved_[v] = 1;
    put(v, static_cast<Side>(side));
    for (std::int32_t e = graph_.first[v]; e < graph_.first[v + 1]; ++e) {
      const std::int32_t u = graph_.neighbours[e];
      if (sides_[u] == Side::separator) change_gain(u, 1 - side, -graph_.weights[v]);
      if (sides_[u] == other) pulled_.push_back(u);
    }
    for (std::size_t i = pulled; i < pulled_.size(); ++i) {
      const std::int32_t u = pulled_[i];
      for (std::int32_t e = graph_.first[u]; e < graph_.first[u + 1]; ++e)
        if (sides_[graph_.neighbours[e]] == Side::separator)
          change_gain(graph_.neighbours[e], side, graph_.weights[u]);
      put(u, Side::separator);
      enter(u);
    }
  }

  void take_back_last() {
    const Move last = moves_.back();
    moves_.pop_back();
    put(last.vertex, Side::separator);
    for (; pulled_.size() > last.pulled; pulled_.pop_back())
      put(pulled_.back(), static_cast<Side>(1 - last.side));
  }

  /// Moves every vertex once at most, also at a loss; what comes after the best state is undone.
  void run_pass() {
    std::fill(moved_.begin(), moved_.end(), 0);
    moves_.clear();
    pulled_.clear();
    for (auto& queue : queues_) queue = {};
    std::size_t patience = 50, keep = 0;
    for (std::int32_t v = 0; v < graph_.size(); ++v)
      if (sides_[v] == Side::separator) {
        enter(v);
        patience = std::min<std::size_t>(patience + 2, 300);
      }
    double least = cost();
    while (moves_.size() < keep + patience) {
      const std::int32_t left = best(0), right = best(1);
      if (left < 0 && right < 0) break;
      const auto to_right = [&] {
        if (left < 0 || right < 0) return left < 0;
        const std::int32_t difference = gains_[1][right] - gains_[0][left];
        return difference != 0 ? difference > 0 : weights_[0] > weights_[1];
      };
      to_right() ? move(right, 1) : move(left, 0);
      if (cost() < least) {
        least = cost();
        keep = moves_.size();
      }
    }
    while (moves_.size() > keep) take_back_last();
  }

  const WeightedGraph& graph_;
  std::vector<Side>& sides_;
  std::vector<char> moved_;  // in this pass
  Indices gains_[2];         // of a vertex of the separator when it moves to a side
  std::priority_queue<std::pair<std::int32_t, std::int32_t>> queues_[2];  // also of former gains
  std::vector<Move> moves_;
  Indices pulled_;
  std::int64_t weights_[3] = {};
  std::int64_t most_;  // that a side may have
};

/// Grows one side from a vertex, by breadth, until it has half of the weight.
std::vector<Side> grown(const WeightedGraph& graph, std::int32_t start) {
  std::vector<Side> sides(graph.size(), Side::right);
  std::int64_t total = 0, reached = 0;
  for (const std::int32_t weight : graph.weights) total += weight;
  Indices front{start};
  sides[start] = Side::left;
  std::int32_t next = 0;  // component
  for (std::size_t head = 0; head < front.size(); ++head) {
    const std::int32_t v = front[head];
    // what is seen but not reached lies between
    if (2 * reached >= total) {
      sides[v] = Side::separator;
      continue;
    }
    reached += graph.weights[v];
    for (std::int32_t e = graph.first[v]; e < graph.first[v + 1]; ++e)
      if (std::exchange(sides[graph.neighbours[e]], Side::left) == Side::right)
        front.push_back(graph.neighbours[e]);
    if (head + 1 < front.size() || 2 * reached >= total) continue;
    while (sides[next] != Side::right) ++next;
    sides[next] = Side::left;
    front.push_back(next);
  }
  return sides;
}

}  // namespace

std::vector<Side> find_separator(const WeightedGraph& graph) {
  static const std::int32_t kCoarsest = getenv("KC") ? atoi(getenv("KC")) : 100;
  static const std::int64_t kStarts = getenv("ST") ? atoi(getenv("ST")) : 6;
  std::vector<Side> best;
  if (graph.size() > kCoarsest) {
    Indices coarse;
    const WeightedGraph smaller = coarsened(graph, coarse);
    if (smaller.size() < 0.95 * graph.size()) {
      const std::vector<Side> sides = find_separator(smaller);
      for (const std::int32_t c : coarse) best.push_back(sides[c]);
      Refinement(graph, best).run();
      return best;
    }
  }
  double least = 0.0;
  for (std::int64_t k = 0; k < kStarts; ++k) {
    auto sides = grown(graph, static_cast<std::int32_t>(k * graph.size() / kStarts));
    Refinement refinement(graph, sides);
    refinement.run();
    if (best.empty() || refinement.cost() < least) {
      least = refinement.cost();
      best = std::move(sides);
    }
  }
  return best;
}

}  // namespace snapspace
