#include "snapshots/combine_rows.h"

#include <algorithm>
#include <cstring>
#include <vector>

#include "memory/streamed_vector.h"
#include "simd/memory.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

using Wide = Lanes<kWideLanes>;

/// Combinations and packs of columns whose sums stay in registers.
constexpr std::size_t kGroup = 4, kPacks = 3;
/// Such tiles side by side: 512 rows of them take 400 kB and stay in the second-level cache.
constexpr std::size_t kTiles = 4;
constexpr std::size_t kColumns = kPacks * kWideLanes, kBlock = kTiles * kColumns;
/// Columns of one thread's part.
constexpr std::size_t kPart = 16 * kBlock;

/// A row that some combinations of a group take, with the weight in each.
struct Term {
  std::size_t row;
  double weights[kGroup];
};
using Terms = std::vector<Term>;

/// The rows that some combinations take.
std::vector<std::size_t> used_rows(const double* weights, std::size_t rows,
                                   std::size_t combinations) {
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < combinations; ++j)
      if (weights[j * rows + i] != 0.0) {
        used.push_back(i);
        break;
      }
  return used;
}

/// The terms of a group, with rows counted among the `used` ones.
Terms terms_of(const double* weights, std::size_t rows, std::size_t combinations,
               std::span<const std::size_t> used) {
  Terms terms;
  for (std::size_t place = 0; place < used.size(); ++place) {
    Term term{place, {}};
    for (std::size_t j = 0; j < combinations; ++j)
      term.weights[j] = weights[j * rows + used[place]];
    if (std::any_of(term.weights, term.weights + kGroup, [](double w) { return w != 0.0; }))
      terms.push_back(term);
  }
  return terms;
}

/// The sums of one tile; `tile` holds its packs row by row.
void combine(const Terms& terms, const Wide* tile, Wide sums[kGroup][kPacks]) {
  Wide tiles[kGroup][kPacks];
#pragma GCC unroll 4
  for (std::size_t j = 0; j < kGroup; ++j)
#pragma GCC unroll 3
    for (std::size_t p = 0; p < kPacks; ++p) tiles[j][p] = Wide(0.0);
  for (const Term& term : terms) {
    const Wide* packs = tile + term.row * kPacks;
#pragma GCC unroll 4
    for (std::size_t j = 0; j < kGroup; ++j) {
      const Wide weight(term.weights[j]);
#pragma GCC unroll 3
      for (std::size_t p = 0; p < kPacks; ++p) tiles[j][p] += weight * packs[p];
    }
  }
  std::copy_n(&tiles[0][0], kGroup * kPacks, &sums[0][0]);
}

/// Columns of all rows, copied so that each tile is contiguous.
class Block {
 public:
  explicit Block(std::span<const double* const> rows)
      : rows_(rows), packs_(kTiles * kPacks * rows.size(), Wide(0.0)) {}

  /// Numbers beyond the last column of a tile are left over from earlier ones.
  void copy(std::size_t begin, std::size_t columns) {
    for (std::size_t i = 0; i < rows_.size(); ++i)
      for (std::size_t first = 0; first < columns; first += kColumns)
        std::memcpy(static_cast<void*>(&packs_[(first / kColumns * rows_.size() + i) * kPacks]),
                    rows_[i] + begin + first, std::min(kColumns, columns - first) * sizeof(double));
  }

  const Wide* tile(std::size_t index) const { return &packs_[index * rows_.size() * kPacks]; }

 private:
  std::span<const double* const> rows_;
  StreamedVector<Wide> packs_;
};

}  // namespace

void combine_rows(std::span<const double* const> rows, std::size_t size, const double* weights,
                  std::size_t combinations, double* combined, int threads) {
  const std::vector<std::size_t> used = used_rows(weights, rows.size(), combinations);
  std::vector<const double*> taken;
  for (const std::size_t row : used) taken.push_back(rows[row]);
  std::vector<Terms> groups;
  for (std::size_t j = 0; j < combinations; j += kGroup)
    groups.push_back(
        terms_of(weights + j * rows.size(), rows.size(), std::min(kGroup, combinations - j), used));
  const auto of_block = [&](const Block& block, std::size_t begin, std::size_t columns) {
    for (std::size_t g = 0; g < groups.size(); ++g)
      for (std::size_t first = 0; first < columns; first += kColumns) {
        Wide sums[kGroup][kPacks];
        combine(groups[g], block.tile(first / kColumns), sums);
        for (std::size_t j = g * kGroup; j < std::min((g + 1) * kGroup, combinations); ++j)
          std::memcpy(combined + j * size + begin + first, sums[j % kGroup],
                      std::min(kColumns, columns - first) * sizeof(double));
      }
  };
  parallel_for(static_cast<int>((size + kPart - 1) / kPart), threads, [&](int part) {
    Block block(taken);
    const std::size_t end = std::min((part + 1) * kPart, size);
    for (std::size_t begin = part * kPart; begin < end; begin += kBlock) {
      const std::size_t columns = std::min(kBlock, end - begin);
      block.copy(begin, columns);
      of_block(block, begin, columns);
    }
  });
}

}  // namespace snapspace
