#include "cholesky/supernodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace snapspace {

namespace {

using Indices = std::vector<std::int32_t>;
using Pattern = Eigen::SparseMatrix<double>;

/// Columns with the same rows below them, both numbered in elimination order.
struct Panel {
  Indices columns, rows;
  std::int32_t parent = -1;
};

Indices inverse(const Indices& order) {
  Indices places(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) places[order[i]] = static_cast<std::int32_t>(i);
  return places;
}

/// The nodes of a forest, children before their parents and subtrees together.
Indices postorder(const Indices& parent) {
  const auto n = static_cast<std::int32_t>(parent.size());
  Indices child(n, -1), sibling(n, -1), order, path;
  order.reserve(n);
  for (std::int32_t v = n - 1; v >= 0; --v)
    if (parent[v] >= 0) sibling[v] = std::exchange(child[parent[v]], v);
  for (std::int32_t root = 0; root < n; ++root) {
    if (parent[root] >= 0) continue;
    path.push_back(root);
    while (!path.empty()) {
      const std::int32_t v = path.back(), c = child[v];
      if (c >= 0) {
        child[v] = sibling[c];
        path.push_back(c);
      } else {
        path.pop_back();
        order.push_back(v);
      }
    }
  }
  return order;
}

/// The first row below the diagonal in each column of the factor [Liu 1990].
Indices elimination_tree(const Pattern& A, const Indices& order) {
  const auto n = static_cast<std::int32_t>(order.size());
  const Indices places = inverse(order);
  Indices parent(n, -1), ancestor(n, -1);
  for (std::int32_t j = 0; j < n; ++j)
    for (Pattern::InnerIterator entry(A, order[j]); entry; ++entry)
      for (std::int32_t i = places[entry.row()]; i >= 0 && i < j;) {
        const std::int32_t next = std::exchange(ancestor[i], j);
        if (next < 0) parent[i] = j;
        i = next;
      }
  return parent;
}

/// The panels of the factor without any explicit zero; `order` is a postorder of its tree.
std::vector<Panel> exact_panels(const Pattern& A, const Indices& order) {
  const auto n = static_cast<std::int32_t>(order.size());
  const Indices places = inverse(order);
  std::vector<Panel> panels;
  Indices seen(n, -1);     // the last panel that has the row
  Indices waiting(n, -1);  // the first of the closed panels whose first row is the column
  Indices next;            // the next such panel after each panel
  // Whether the test holds for all rows that A and the panels below contribute to a column.
  const auto all_rows = [&](std::int32_t j, auto&& test) {
    for (Pattern::InnerIterator entry(A, order[j]); entry; ++entry)
      if (places[entry.row()] > j && !test(places[entry.row()])) return false;
    for (std::int32_t p = waiting[j]; p >= 0; p = next[p])
      for (const std::int32_t row : panels[p].rows)
        if (row > j && !test(row)) return false;
    return true;
  };
  const auto close = [&](std::int32_t p) {
    Indices& rows = panels[p].rows;
    const std::int32_t last = panels[p].columns.back();
    rows.erase(std::remove_if(rows.begin(), rows.end(), [&](auto r) { return r <= last; }),
               rows.end());
    if (rows.empty()) return;
    const std::int32_t first = *std::min_element(rows.begin(), rows.end());
    next[p] = std::exchange(waiting[first], p);
  };
  for (std::int32_t j = 0; j < n; ++j) {
    auto p = static_cast<std::int32_t>(panels.size()) - 1;
    const bool joins =
        p >= 0 && seen[j] == p && all_rows(j, [&](std::int32_t row) { return seen[row] == p; });
    if (!joins) {
      if (p >= 0) close(p);
      panels.emplace_back();
      next.push_back(-1);
      ++p;
      all_rows(j, [&](std::int32_t row) {
        if (std::exchange(seen[row], p) != p) panels[p].rows.push_back(row);
        return true;
      });
    }
    panels[p].columns.push_back(j);
    for (std::int32_t c = waiting[j]; c >= 0; c = next[c]) panels[c].parent = p;
  }
  if (n > 0) close(static_cast<std::int32_t>(panels.size()) - 1);
  return panels;
}

/// Time of a solve with a panel, in units of the product of an entry with a vertex. Each block of
/// columns visits all rows below it; each visit and each block has a fixed cost.
double solve_cost(double columns, double rows) {
  constexpr double kVisit = 2.0, kBlock = 12.0;
  const double blocks = std::ceil(columns / column_block());
  const double visits = blocks * rows + 0.5 * (blocks - 1.0) * columns;
  return columns * (0.5 * columns + rows) + kVisit * visits + kBlock * blocks;
}

/// Merges panels into their parents where that saves more than the added zeros cost. Returns the
/// panel into which each was merged, or -1.
Indices merge(std::vector<Panel>& panels) {
  const auto count = static_cast<std::int32_t>(panels.size());
  Indices child(count, -1), sibling(count, -1), into(count, -1);
  const auto cost = [](std::size_t columns, std::size_t rows) {
    return solve_cost(static_cast<double>(columns), static_cast<double>(rows));
  };
  for (std::int32_t p = 0; p < count; ++p) {
    Indices& own = panels[p].columns;
    const std::size_t rows = panels[p].rows.size();
    for (std::int32_t c = child[p]; c >= 0; c = sibling[c]) {
      const Indices& others = panels[c].columns;
      const double separate = cost(own.size(), rows) + cost(others.size(), panels[c].rows.size());
      if (cost(own.size() + others.size(), rows) > separate) continue;
      own.insert(own.end(), others.begin(), others.end());
      into[c] = p;
    }
    if (panels[p].parent >= 0) sibling[p] = std::exchange(child[panels[p].parent], p);
  }
  return into;
}

}  // namespace

Supernodes::Supernodes(const Pattern& A, const Indices& elimination) {
  const Indices columns = postorder(elimination_tree(A, elimination));
  Indices exact;
  for (const std::int32_t j : columns) exact.push_back(elimination[j]);
  std::vector<Panel> panels = exact_panels(A, exact);
  const Indices into = merge(panels);

  // The remaining forest of panels, in a new postorder.
  const auto all = static_cast<std::int32_t>(panels.size());
  Indices top(all), left, number(all), above;
  for (std::int32_t p = all - 1; p >= 0; --p) top[p] = into[p] < 0 ? p : top[into[p]];
  for (std::int32_t p = 0; p < all; ++p)
    if (top[p] == p) {
      number[p] = static_cast<std::int32_t>(left.size());
      left.push_back(p);
    }
  for (const std::int32_t p : left)
    above.push_back(panels[p].parent < 0 ? -1 : number[top[panels[p].parent]]);
  const Indices sequence = postorder(above), rank = inverse(sequence);

  Indices renumbered(exact.size());
  order.reserve(exact.size());
  for (const std::int32_t s : sequence) {
    Indices& own = panels[left[s]].columns;
    std::sort(own.begin(), own.end());
    for (const std::int32_t j : own) {
      renumbered[j] = static_cast<std::int32_t>(order.size());
      order.push_back(exact[j]);
    }
    first_column.push_back(static_cast<std::int32_t>(order.size()));
    parent.push_back(above[s] < 0 ? -1 : rank[above[s]]);
  }
  for (const std::int32_t s : sequence) {
    for (const std::int32_t row : panels[left[s]].rows) rows.push_back(renumbered[row]);
    std::sort(rows.begin() + first_row.back(), rows.end());
    first_row.push_back(static_cast<std::int64_t>(rows.size()));
  }
}

Indices Supernodes::places() const { return inverse(order); }

std::int64_t Supernodes::entries() const {
  std::int64_t total = 0;
  for (std::int32_t s = 0; s < count(); ++s) {
    const std::int64_t own = columns(s);
    total += own * (own + 1) / 2 + own * static_cast<std::int64_t>(below(s).size());
  }
  return total;
}

}  // namespace snapspace
