#pragma once
#include <algorithm>
#include <cstddef>

#include "online/packed_layout.h"
#include "simd/memory.h"

/// The loops that read all coefficients of a quartic once. `Stored` is double or float.

namespace snapspace::online {

inline constexpr int kPack = kWideLanes;
using Numbers = Lanes<kPack>;

/// Pairs of the blocks that are visited together. The sums of four columns over so many pairs stay
/// in a first-level cache of 32 kB or more while the coefficients stream through it.
inline constexpr std::size_t kChunk = 320;

/// Pairs begin <= p < end.
struct Range {
  std::size_t begin, end;
};

/// For the blocks c_kl of Rows neighbouring k and Columns of l, and a range of their pairs:
/// forms_kl = sum_p c_kl[p] pairs[p], and weights[p] += sum_kl x_k x_l c_kl[p].
/// @param blocks  of the first k, for each l; the next k follows `size` numbers later
template <int Rows, int Columns, class Stored>
inline void contract_pairs(const Stored* const* blocks, std::size_t size, Range range,
                           const double* pairs, const double* x_k, const double* x_l,
                           double* weights, double* forms) {
  Numbers sums[Columns * Rows], factors[Columns * Rows];
  for (int c = 0; c < Columns; ++c)
    for (int r = 0; r < Rows; ++r) {
      sums[c * Rows + r] = Numbers(0.0);
      factors[c * Rows + r] = Numbers(x_k[r] * x_l[c]);
    }
  for (std::size_t p = range.begin; p < range.end; p += kPack) {
    const Numbers pair = load<kPack>(pairs + p);
    Numbers weight = load<kPack>(weights + p);
    for (int c = 0; c < Columns; ++c)
      for (int r = 0; r < Rows; ++r) {
        Numbers entry = load<kPack>(blocks[c] + r * size + p);
        keep_in_register(entry);
        sums[c * Rows + r] += entry * pair;
        weight += entry * factors[c * Rows + r];
      }
    store(weights + p, weight);
  }
  lane_sums<Columns * Rows>(sums, forms);
}

/// For the same, k < l: forms_kl = sum_p c_kl[p] pairs[p], cubic_k[p] += sum_l x_l c_kl[p], and
/// cubic_l[p] += sum_k x_k c_kl[p].
/// @param cubic_k  of the first k; the next k follows `size` numbers later
template <int Rows, int Columns, class Stored>
inline void contract_cubic(const Stored* const* blocks, std::size_t size, Range range,
                           const double* pairs, const double* x_k, const double* x_l,
                           double* cubic_k, double* const* cubic_l, double* forms) {
  Numbers sums[Columns * Rows], row_factors[Rows], column_factors[Columns];
  for (int r = 0; r < Rows; ++r) row_factors[r] = Numbers(x_k[r]);
  for (int c = 0; c < Columns; ++c) {
    column_factors[c] = Numbers(x_l[c]);
    for (int r = 0; r < Rows; ++r) sums[c * Rows + r] = Numbers(0.0);
  }
  for (std::size_t p = range.begin; p < range.end; p += kPack) {
    const Numbers pair = load<kPack>(pairs + p);
    Numbers rows[Rows];
    for (int r = 0; r < Rows; ++r) rows[r] = load<kPack>(cubic_k + r * size + p);
    for (int c = 0; c < Columns; ++c) {
      Numbers column = load<kPack>(cubic_l[c] + p);
      keep_in_register(column);
      for (int r = 0; r < Rows; ++r) {
        Numbers entry = load<kPack>(blocks[c] + r * size + p);
        keep_in_register(entry);
        sums[c * Rows + r] += entry * pair;
        rows[r] += entry * column_factors[c];
        column += entry * row_factors[r];
      }
      store(cubic_l[c] + p, column);
    }
    for (int r = 0; r < Rows; ++r) store(cubic_k + r * size + p, rows[r]);
  }
  lane_sums<Columns * Rows>(sums, forms);
}

/// For the blocks c_aa, c_ab and c_bb of b = a + 1: their forms, and the same sums in cubic_a and
/// cubic_b. A diagonal block counts as row and as column.
/// @param blocks  of (a, a), which (b, a) would follow, and of (a, b), which (b, b) follows
template <class Stored>
inline void contract_corner(const Stored* const* blocks, std::size_t size, const double* pairs,
                            const double* x_a, double* cubic_a, double* forms) {
  Numbers sums[4];
  for (Numbers& s : sums) s = Numbers(0.0);
  const Numbers a(x_a[0]), b(x_a[1]), twice_a(2.0 * x_a[0]), twice_b(2.0 * x_a[1]);
  double* cubic_b = cubic_a + size;
  for (std::size_t p = 0; p < size; p += kPack) {
    const Numbers pair = load<kPack>(pairs + p);
    Numbers aa = load<kPack>(blocks[0] + p), ab = load<kPack>(blocks[1] + p);
    Numbers bb = load<kPack>(blocks[1] + size + p);
    keep_in_register(aa);
    keep_in_register(ab);
    keep_in_register(bb);
    sums[0] += aa * pair;
    sums[1] += ab * pair;
    sums[2] += bb * pair;
    store(cubic_a + p, load<kPack>(cubic_a + p) + twice_a * aa + b * ab);
    store(cubic_b + p, load<kPack>(cubic_b + p) + a * ab + twice_b * bb);
  }
  lane_sums<4>(sums, forms);
}

/// Visits the blocks of the columns l ... l + Columns - 1, l odd.
template <int Columns, class Visit>
inline void visit_columns(int l, Visit& visit) {
  visit.columns(l, Columns);
  visit.template tile<1, Columns>(0, l, {0, PackedLayout::block_size(0)});
  int first = 1;
  for (std::size_t begin = 0; first < l; begin += kChunk)
    for (int k = first; k < l; k += 2) {
      const std::size_t size = PackedLayout::block_size(k);
      if (size <= begin + kChunk) first = k + 2;  // ends here
      visit.template tile<2, Columns>(k, l, {begin, std::min(size, begin + kChunk)});
    }
  if constexpr (Columns == 4) visit.template tile<2, 2>(l, l + 2, {0, PackedLayout::block_size(l)});
  if constexpr (Columns == 1) visit.diagonal(l);
  for (int a = l; a + 1 < l + Columns; a += 2) visit.corner(a);
}

/// Visits all blocks k <= l < n in tiles of neighbouring rows k and columns l, as large as there
/// are registers for: the fewer sums are read and written for a coefficient, the better.
template <class Visit>
inline void visit_blocks(int n, Visit visit) {
  visit.columns(0, 1);
  visit.diagonal(0);
  int l = 1;
  if constexpr (kPack >= 8)
    for (; l + 4 <= n; l += 4) visit_columns<4>(l, visit);
  for (; l + 2 <= n; l += 2) visit_columns<2>(l, visit);
  if (l < n) visit_columns<1>(l, visit);
}

}  // namespace snapspace::online
