#include "cholesky/separator_refinement.h"

#include <algorithm>
#include <queue>
#include <utility>

namespace snapspace {

namespace {

/// The side to which a pass moves vertices. A separator that moves to one side only can leave local
/// minima that hold it while vertices move both ways. This saves a tenth of the factor's entries in
/// solid bodies.
enum class MoveSide : std::int8_t { left, right, either };

class Refinement {
 public:
  Refinement(const WeightedGraph& graph, std::vector<Side>& sides)
      : graph_(graph), sides_(sides), moved_(graph.size()) {
    for (auto& gain : gains_) gain.resize(graph.size());
    for (std::int32_t v = 0; v < graph.size(); ++v) {
      weights_[static_cast<int>(sides[v])] += graph.weights[v];
      if (sides[v] == Side::separator) members_.push_back(v);
    }
    most_ = 7 * (weights_[0] + weights_[1] + weights_[2]) / 10;
  }

  [[nodiscard]] double cost() const {
    const auto left = static_cast<double>(weights_[0]), right = static_cast<double>(weights_[1]);
    const double uneven = (left - right) / std::max(1.0, left + right);
    return static_cast<double>(weights_[2]) * (1.0 + 0.5 * uneven * uneven);
  }

  [[nodiscard]] MoveSide lighter() const {
    return weights_[0] <= weights_[1] ? MoveSide::left : MoveSide::right;
  }

  /// Moves each vertex at most once, even at a loss, and undoes all moves after the best state.
  void run_pass(MoveSide towards) {
    open_[0] = towards != MoveSide::right;
    open_[1] = towards != MoveSide::left;
    std::size_t patience = start_pass(), keep = 0;
    double least = cost();
    while (moves_.size() < keep + patience) {
      const std::int32_t left = best(0), right = best(1);
      if (left < 0 && right < 0) break;
      bool to_right = left < 0;
      if (left >= 0 && right >= 0) {
        const std::int32_t difference = gains_[1][right] - gains_[0][left];
        to_right = difference != 0 ? difference > 0 : weights_[0] > weights_[1];
      }
      to_right ? move(right, 1) : move(left, 0);
      if (cost() < least) {
        least = cost();
        keep = moves_.size();
      }
    }
    while (moves_.size() > keep) undo_last();
  }

 private:
  struct Move {
    std::int32_t vertex;
    int side;
    std::size_t pulled;  // first of the vertices that entered the separator for it
  };

  /// Returns how many moves without a better state are enough.
  std::size_t start_pass() {
    ++pass_;
    moves_.clear();
    pulled_.clear();
    for (auto& queue : queues_) queue = {};
    std::sort(members_.begin(), members_.end());
    members_.erase(std::unique(members_.begin(), members_.end()), members_.end());
    std::erase_if(members_, [&](std::int32_t v) { return sides_[v] != Side::separator; });
    for (const std::int32_t v : members_) enter(v);
    return std::min<std::size_t>(25 + 2 * members_.size(), 300);
  }

  void put(std::int32_t v, Side side) {
    weights_[static_cast<int>(sides_[v])] -= graph_.weights[v];
    weights_[static_cast<int>(side)] += graph_.weights[v];
    sides_[v] = side;
  }

  [[nodiscard]] bool has_moved(std::int32_t v) const { return moved_[v] == pass_; }

  void queue(std::int32_t v, int side) {
    if (open_[side] && !has_moved(v)) queues_[side].push({gains_[side][v], v});
  }

  void change_gain(std::int32_t v, int side, std::int32_t change) {
    gains_[side][v] += change;
    // a lowered gain is put in its place when it reaches the top
    if (change > 0) queue(v, side);
  }

  /// Sets the gains of a vertex that joins the separator: its own weight, less that of the
  /// neighbours that would enter for it.
  void enter(std::int32_t v) {
    std::int32_t pulled[2] = {};
    for (const std::int32_t u : graph_.around(v))
      if (sides_[u] != Side::separator) pulled[sides_[u] == Side::left] += graph_.weights[u];
    for (int side = 0; side < 2; ++side) {
      gains_[side][v] = graph_.weights[v] - pulled[side];
      queue(v, side);
    }
  }

  /// The vertex with the best gain that may still move to the side, or -1.
  std::int32_t best(int side) {
    auto& queue = queues_[side];
    while (!queue.empty()) {
      const auto [gain, v] = queue.top();
      const bool free = !has_moved(v) && sides_[v] == Side::separator;
      if (free && gains_[side][v] == gain && weights_[side] + graph_.weights[v] <= most_) return v;
      queue.pop();
      if (free && gains_[side][v] < gain) queue.push({gains_[side][v], v});
    }
    return -1;
  }

  void move(std::int32_t v, int side) {
    moves_.push_back({v, side, pulled_.size()});
    moved_[v] = pass_;
    put(v, static_cast<Side>(side));
    for (const std::int32_t u : graph_.around(v)) {
      if (sides_[u] == Side::separator) change_gain(u, 1 - side, -graph_.weights[v]);
      if (sides_[u] == static_cast<Side>(1 - side)) pulled_.push_back(u);
    }
    for (std::size_t i = moves_.back().pulled; i < pulled_.size(); ++i) {
      const std::int32_t u = pulled_[i];
      for (const std::int32_t w : graph_.around(u))
        if (sides_[w] == Side::separator) change_gain(w, side, graph_.weights[u]);
      put(u, Side::separator);
      members_.push_back(u);
      enter(u);
    }
  }

  void undo_last() {
    const Move last = moves_.back();
    moves_.pop_back();
    put(last.vertex, Side::separator);
    for (; pulled_.size() > last.pulled; pulled_.pop_back())
      put(pulled_.back(), static_cast<Side>(1 - last.side));
  }

  const WeightedGraph& graph_;
  std::vector<Side>& sides_;
  std::vector<std::int32_t> moved_;     // the last pass that moved a vertex
  std::vector<std::int32_t> members_;   // vertices of the separator, and some that have left it
  std::vector<std::int32_t> gains_[2];  // gain from moving a vertex of the separator to a side
  std::priority_queue<std::pair<std::int32_t, std::int32_t>> queues_[2];  // former gains as well
  std::vector<Move> moves_;
  std::vector<std::int32_t> pulled_;
  std::int64_t weights_[3] = {};
  std::int64_t most_;  // weight of a side
  std::int32_t pass_ = 0;
  bool open_[2] = {};  // whether this pass moves vertices to a side
};

}  // namespace

double refine_separator(const WeightedGraph& graph, std::vector<Side>& sides) {
  constexpr int kMaxPasses = 12;
  Refinement refinement(graph, sides);
  const bool left_first = refinement.lighter() == MoveSide::left;
  const MoveSide turns[] = {left_first ? MoveSide::left : MoveSide::right,
                            left_first ? MoveSide::right : MoveSide::left, MoveSide::either};
  for (int pass = 0, futile = 0; pass < kMaxPasses && futile < 3; ++pass) {
    const double before = refinement.cost();
    refinement.run_pass(turns[pass % 3]);
    futile = refinement.cost() < before ? 0 : futile + 1;
  }
  return refinement.cost();
}

}  // namespace snapspace
