#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "simd/lanes.h"

namespace snapspace::online {

/// Number of monomials q_i q_j, i <= j < n.
constexpr std::size_t pair_count(std::size_t n) { return n * (n + 1) / 2; }
/// Number of monomials of degree three in n variables.
constexpr std::size_t cubic_count(std::size_t n) { return n * (n + 1) / 2 * (n + 2) / 3; }
/// Number of monomials of degree four in n variables, C(n + 3, 4).
constexpr std::size_t quartic_count(std::size_t n) {
  return n * (n + 1) / 2 * (n + 2) / 3 * (n + 3) / 4;
}

inline constexpr int kPack = kWideLanes;
/// Variables per group. A tile belongs to two groups k and l; its sums need kTile^2 registers.
inline constexpr int kTile = kPack >= 8 ? 4 : 2;
/// Rows j of pairs (i, j) that are visited together, in the first chunk and in the others. Their
/// part of all cubic forms stays in a first-level cache of 48 kB while the coefficients stream
/// through it.
inline constexpr int kFirstRows = 12, kChunkRows = 8;

/// A range of packs of pairs, begin <= p < end.
struct PairPacks {
  int begin, end;
};

/// The memory layout of the coefficients of x_i x_j x_k x_l, i <= j <= k <= l, during a live solve:
/// in the order in which an evaluation reads them, once.
/// The variables after the first one are in groups of kTile; only the first group, where it costs
/// little, may be incomplete. Pairs (i, j), i fastest, are in packs. Pairs are the slowest index:
/// each chunk of pairs visits all tiles (k, l). A tile holds, for each of its packs, the rows k of
/// its first column l, then those of the next column. Pairs with j > k and missing variables have
/// zeros, 7 % at n = 41. Coefficients with i = j = k = 0 are not included: they are the linear
/// part. In files l is the slowest index, and fewer variables are a prefix; here the tiles of fewer
/// variables are a part of each chunk.
class PackedLayout {
 public:
  explicit PackedLayout(int variables)
      : groups_((variables - 1 + kTile - 1) / kTile),
        missing_(groups_ * kTile - (variables - 1)),
        forms_(groups_ + 1) {
    for (int g = 0; g < groups_; ++g) forms_[g + 1] = forms_[g] + kTile * form_size(g);
  }

  static constexpr std::size_t padded(std::size_t count) { return (count + 7) / 8 * 8; }
  /// Number of packs of the pairs i <= j <= k; 0 if there is no such k.
  static constexpr int packs_to(int k) {
    return k < 1 ? 0 : static_cast<int>((pair_count(k + 1) + kPack - 1) / kPack);
  }

  [[nodiscard]] int groups() const { return groups_; }
  /// Number of groups of the first `variables` variables.
  [[nodiscard]] int groups_of(int variables) const { return place(variables - 1) / kTile + 1; }
  /// Position of a variable, except the first one, if all groups were full.
  [[nodiscard]] int place(int variable) const { return variable - 1 + missing_; }
  /// The first variable of a group. In the first group it may be less than 1, which means a missing
  /// one.
  [[nodiscard]] int variable(int group) const { return group * kTile + 1 - missing_; }
  /// Number of packs of the pairs of a group.
  [[nodiscard]] int packs(int group) const { return packs_to(variable(group + 1) - 1); }
  /// Number of pairs of all variables, in whole packs.
  [[nodiscard]] std::size_t pairs() const { return form_size(groups_ - 1); }

  /// Size of a quadratic form in the pairs of a group, with padding.
  [[nodiscard]] std::size_t form_size(int group) const {
    return static_cast<std::size_t>(packs(group)) * kPack;
  }
  /// Offset of the first form of a group among the forms of all variables except the first.
  [[nodiscard]] std::size_t form(int group) const { return forms_[group]; }

  /// Number of coefficients in all tiles.
  [[nodiscard]] std::size_t size() const { return visit(groups_, CountOnly()); }

  /// Calls visit.diagonal<First>(group, packs, place) and visit.tile<First>(group of k, group of l,
  /// packs, place) for the tiles of the first `groups` groups. In each chunk the diagonal comes
  /// first. Packs that belong only to the later rows of a tile form another tile, of the rows First
  /// ...
  /// @return  number of coefficients in all tiles
  template <class Visit>
  std::size_t visit(int groups, Visit&& visit) const {
    std::size_t place = 0;
    int begin = 0;
    for (int row = kFirstRows; begin < packs(groups - 1); row += kChunkRows) {
      const int end = std::min(packs_to(row), packs(groups_ - 1));
      for (int g = 0; g < groups_; ++g) {
        const bool included = g < groups;
        const PairPacks all = shared(g, begin, end), rest{all.end, std::min(packs(g), end)};
        if (included && all.begin < all.end) visit.template diagonal<0>(g, all, place);
        place += size(all, kTile * (kTile + 1) / 2);
        if (included && rest.begin < rest.end) visit.template diagonal<kTile - 2>(g, rest, place);
        place += size(rest, 3);
      }
      for (int g = 0; g < groups_; ++g) {
        const PairPacks all = shared(g, begin, end), rest{all.end, std::min(packs(g), end)};
        for (int h = g + 1; h < groups_; ++h) {
          const bool included = h < groups;
          if (included && all.begin < all.end) visit.template tile<0>(g, h, all, place);
          place += size(all, kTile * kTile);
          if (included && rest.begin < rest.end) visit.template tile<kTile - 2>(g, h, rest, place);
          place += size(rest, 2 * kTile);
        }
      }
      begin = end;
    }
    return place;
  }

 private:
  struct CountOnly {
    template <int First>
    void diagonal(int, PairPacks, std::size_t) {}
    template <int First>
    void tile(int, int, PairPacks, std::size_t) {}
  };

  static constexpr std::size_t size(PairPacks packs, int blocks) {
    return packs.begin < packs.end
               ? static_cast<std::size_t>(packs.end - packs.begin) * blocks * kPack
               : 0;
  }
  /// Packs that all rows of a group share.
  [[nodiscard]] PairPacks shared(int group, int begin, int end) const {
    const int last = kTile > 2 ? packs_to(variable(group) + 1) : packs(group);
    return {begin, std::max(begin, std::min(last, end))};
  }

  int groups_, missing_;
  std::vector<std::size_t> forms_;
};

}  // namespace snapspace::online
