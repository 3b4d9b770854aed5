#pragma once
#include <cstddef>
#include <vector>

namespace snapspace::online {

/// Number of monomials q_i q_j, i <= j < n.
constexpr std::size_t pair_count(std::size_t n) { return n * (n + 1) / 2; }
/// Number of monomials of degree four in n variables, C(n + 3, 4).
constexpr std::size_t quartic_count(std::size_t n) {
  return n * (n + 1) / 2 * (n + 2) / 3 * (n + 3) / 4;
}

/// Where the coefficients of x_i x_j x_k x_l, i <= j <= k <= l < n, lie in memory during a live
/// solve.
///
/// For fixed (k, l) the pairs i <= j <= k, i fastest, are one block, and k is faster than l. In
/// files the blocks follow each other without gaps. In memory they are padded with zeros, so that
/// the blocks of k and k + 1, k odd, have one size and that is a whole number of cache lines: two
/// blocks are then one loop, and no pack straddles two lines. It costs 6 % at n = 41. In both,
/// fewer variables are a prefix.
class PackedLayout {
 public:
  static constexpr std::size_t kAlignment = 8;  // doubles in 64 bytes

  explicit PackedLayout(int variables) : rows_(variables + 1), slices_(variables + 1) {
    for (int k = 0; k < variables; ++k) {
      rows_[k + 1] = rows_[k] + block_size(k);
      slices_[k + 1] = slices_[k] + rows_[k + 1];
    }
  }

  static constexpr std::size_t padded(std::size_t count) {
    return (count + kAlignment - 1) / kAlignment * kAlignment;
  }
  /// Numbers of a block of k with its padding.
  static constexpr std::size_t block_size(int k) { return padded(pair_count(k + 1 + k % 2)); }

  [[nodiscard]] std::size_t row(int k) const { return rows_[k]; }
  /// Place of block (k, l), k <= l.
  [[nodiscard]] std::size_t block(int k, int l) const { return slices_[l] + rows_[k]; }
  /// Numbers in all blocks of the first `variables` variables.
  [[nodiscard]] std::size_t size(int variables) const { return slices_[variables]; }

 private:
  std::vector<std::size_t> rows_, slices_;
};

}  // namespace snapspace::online
