#include "multigrid/aggregates.h"

namespace snapspace {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

constexpr std::int32_t kNone = -1;

template <class Visit>
void each_neighbour(const Matrix& A, std::int32_t v, Visit visit) {
  for (Matrix::InnerIterator entry(A, v); entry; ++entry)
    visit(static_cast<std::int32_t>(entry.row()));
}

/// Begins an aggregate with an unknown and those of its neighbours that are in none yet.
void begin_aggregate(const Matrix& A, std::int32_t v, Aggregates& aggregates) {
  each_neighbour(A, v, [&](std::int32_t w) {
    if (aggregates.of[w] == kNone) aggregates.of[w] = aggregates.count;
  });
  ++aggregates.count;
}

}  // namespace

Aggregates aggregated(const Matrix& A) {
  const auto size = static_cast<std::int32_t>(A.cols());
  Aggregates aggregates{std::vector<std::int32_t>(size, kNone)};
  for (std::int32_t v = 0; v < size; ++v) {
    bool all_free = true;
    each_neighbour(A, v, [&](std::int32_t w) { all_free &= aggregates.of[w] == kNone; });
    if (all_free) begin_aggregate(A, v, aggregates);
  }
  const std::vector<std::int32_t> whole = aggregates.of;
  for (std::int32_t v = 0; v < size; ++v)
    each_neighbour(A, v, [&](std::int32_t w) {
      if (aggregates.of[v] == kNone) aggregates.of[v] = whole[w];
    });
  return aggregates;
}

}  // namespace snapspace
