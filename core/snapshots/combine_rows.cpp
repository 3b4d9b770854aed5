#include "snapshots/combine_rows.h"

#include <algorithm>
#include <vector>

#include "simd/memory.h"

namespace snapspace {

namespace {

using Wide = Lanes<kWideLanes>;

/// Columns whose sums stay in registers, and columns of all rows that stay in the second-level
/// cache.
constexpr std::size_t kPacks = 8;
constexpr std::size_t kColumns = kPacks * kWideLanes;
constexpr std::size_t kBlock = 4 * kColumns;

struct Term {
  const double* row;
  double weight;
};

/// The sums of `kColumns` columns.
void combine(const std::vector<Term>& terms, std::size_t column, double* combined) {
  Wide sums[kPacks];
#pragma GCC unroll 8
  for (Wide& sum : sums) sum = Wide(0.0);
  for (const Term& term : terms) {
    const Wide weight(term.weight);
#pragma GCC unroll 8
    for (std::size_t p = 0; p < kPacks; ++p)
      sums[p] += weight * load<kWideLanes>(term.row + column + p * kWideLanes);
  }
#pragma GCC unroll 8
  for (std::size_t p = 0; p < kPacks; ++p) store(combined + column + p * kWideLanes, sums[p]);
}

/// The sums of the remaining columns at the end.
void combine_rest(const std::vector<Term>& terms, std::size_t begin, std::size_t end,
                  double* combined) {
  for (std::size_t column = begin; column < end; ++column) {
    double sum = 0.0;
    for (const Term& term : terms) sum += term.weight * term.row[column];
    combined[column] = sum;
  }
}

}  // namespace

void combine_rows(std::span<const double* const> rows, std::size_t size, const double* weights,
                  std::size_t combinations, double* combined) {
  std::vector<std::vector<Term>> terms(combinations);
  for (std::size_t j = 0; j < combinations; ++j)
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (const double weight = weights[j * rows.size() + i]; weight != 0.0)
        terms[j].push_back({rows[i], weight});
  for (std::size_t begin = 0; begin < size; begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, size);
    for (std::size_t j = 0; j < combinations; ++j) {
      double* to = combined + j * size;
      std::size_t column = begin;
      for (; column + kColumns <= end; column += kColumns) combine(terms[j], column, to);
      combine_rest(terms[j], column, end, to);
    }
  }
}

}  // namespace snapspace
