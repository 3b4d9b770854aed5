#pragma once
#include <cstddef>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"

namespace snapspace {

/// The Gram matrix A^T A of a tall matrix whose rows come panel by panel: like syrk of BLAS, but
/// for rows that are written where the product reads them.
/// Columns are in groups of three packs. A tile of the Gram matrix, a few columns of one group by
/// another group, stays in registers while it is summed over the rows of a panel. With about a
/// hundred rows, a group of a panel stays in the first-level cache, and the panel in the
/// second-level cache.
class GramSum {
 public:
  /// @param rows  most rows of a panel
  GramSum(int columns, int rows);

  /// Sets row r of the panel.
  void set_row(int r, const double* row);
  /// Adds the products of the panel's first `rows` rows.
  void add(int rows);
  /// Adds another sum with the same number of columns.
  void add(const GramSum& other);

  /// The sum of the products of columns a and b, a <= b.
  [[nodiscard]] double at(int a, int b) const;

 private:
  using Wide = Lanes<kWideLanes>;
  static constexpr int kPacks = 3;
  static constexpr int kGroup = kPacks * kWideLanes;
  /// Sums of a tile: 24 of 32 registers with AVX-512, 12 of 16 with AVX, 9 of 16 with SSE2.
  static constexpr int kTileColumns = kWideLanes == 8 ? 8 : kWideLanes == 4 ? 4 : 3;
  static_assert(kGroup % kTileColumns == 0);

  /// sums[c][.] += the sum over r of row[r][c] * other[r][.], for the columns c of a tile
  static void add_tile(const double* row, const Wide* other, int rows, Wide* sums);

  int columns_, rows_, groups_;
  StreamedVector<Wide> panel_;  // groups x rows x kPacks
  StreamedVector<Wide> sums_;   // pairs of groups I <= J, by J, x columns of I x kPacks of J
};

}  // namespace snapspace
