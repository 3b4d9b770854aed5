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
/// Variables of a group. A tile is what two groups k and l share; its sums need kTile^2 registers.
inline constexpr int kTile = kPack >= 8 ? 4 : 2;
/// Rows j of pairs (i, j) that are visited together, in the first chunk and in others. Their part
/// of all forms of degree three stays in a nearest cache of 48 kB while coefficients stream through
/// it.
inline constexpr int kFirstRows = 12, kChunkRows = 8;

/// Packs begin <= p < end of pairs.
struct PairPacks {
  int begin, end;
};

/// Where the coefficients of x_i x_j x_k x_l, i <= j <= k <= l, lie in memory during a live solve:
/// in the order in which an evaluation reads them, once.
///
/// The variables behind the first one are taken in groups of kTile, of which only the first, where
/// it costs little, may lack some; and pairs (i, j), i fastest, in packs. Pairs are the slowest:
/// chunk by chunk they visit all tiles (k, l). A tile holds, for each of its packs, the rows k of
/// its first column l, then those of the next. Pairs with j > k and variables that are missing have
/// zeros, 7 % at n = 41. What has i = j = k = 0 is left out: that is the linear part. In files l is
/// slowest and fewer variables are a prefix; here tiles of fewer variables are a part of each
/// chunk.
class PackedLayout {
 public:
  explicit PackedLayout(int variables)
      : groups_((variables - 1 + kTile - 1) / kTile),
        missing_(groups_ * kTile - (variables - 1)),
        forms_(groups_ + 1) {
    for (int g = 0; g < groups_; ++g) forms_[g + 1] = forms_[g] + kTile * form_size(g);
  }

  static constexpr std::size_t padded(std::size_t count) { return (count + 7) / 8 * 8; }
  /// Packs of the pairs i <= j <= k; none if there is no such k.
  static constexpr int packs_to(int k) {
    return k < 1 ? 0 : static_cast<int>((pair_count(k + 1) + kPack - 1) / kPack);
  }

  [[nodiscard]] int groups() const { return groups_; }
  /// Groups of the first variables.
  [[nodiscard]] int groups_of(int variables) const { return place(variables - 1) / kTile + 1; }
  /// Number of a variable, but for the first one, with all groups full.
  [[nodiscard]] int place(int variable) const { return variable - 1 + missing_; }
  /// The first variable of a group; in the first group perhaps less than 1, which is none.
  [[nodiscard]] int variable(int group) const { return group * kTile + 1 - missing_; }
  /// Packs of the pairs of a group.
  [[nodiscard]] int packs(int group) const { return packs_to(variable(group + 1) - 1); }
  /// Pairs of all variables, in whole packs.
  [[nodiscard]] std::size_t pairs() const { return form_size(groups_ - 1); }

  /// Numbers of a form of degree two in the pairs of a group, with padding.
  [[nodiscard]] std::size_t form_size(int group) const {
    return static_cast<std::size_t>(packs(group)) * kPack;
  }
  /// Place of the first form of a group among the forms of all variables but the first.
  [[nodiscard]] std::size_t form(int group) const { return forms_[group]; }

  /// Numbers in all tiles.
  [[nodiscard]] std::size_t size() const { return visit(groups_, Nothing()); }

  /// Calls visit.diagonal<First>(group, packs, place) and visit.tile<First>(group of k, group of l,
  /// packs, place) for the tiles of the first `groups` groups. In each chunk the diagonal comes
  /// first. Packs that only the later rows of a tile have are another tile, of the rows First ...
  template <class Visit>
  std::size_t visit(int groups, Visit&& visit) const {
    std::size_t place = 0;
    int begin = 0;
    for (int row = kFirstRows; begin < packs(groups - 1); row += kChunkRows) {
      const int end = std::min(packs_to(row), packs(groups_ - 1));
      for (int g = 0; g < groups_; ++g) {
        const bool there = g < groups;
        const PairPacks all = shared(g, begin, end), rest{all.end, std::min(packs(g), end)};
        if (there && all.begin < all.end) visit.template diagonal<0>(g, all, place);
        place += size(all, kTile * (kTile + 1) / 2);
        if (there && rest.begin < rest.end) visit.template diagonal<kTile - 2>(g, rest, place);
        place += size(rest, 3);
      }
      for (int g = 0; g < groups_; ++g) {
        const PairPacks all = shared(g, begin, end), rest{all.end, std::min(packs(g), end)};
        for (int h = g + 1; h < groups_; ++h) {
          const bool there = h < groups;
          if (there && all.begin < all.end) visit.template tile<0>(g, h, all, place);
          place += size(all, kTile * kTile);
          if (there && rest.begin < rest.end) visit.template tile<kTile - 2>(g, h, rest, place);
          place += size(rest, 2 * kTile);
        }
      }
      begin = end;
    }
    return place;
  }

 private:
  struct Nothing {
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
  /// Packs that all rows of a group have.
  [[nodiscard]] PairPacks shared(int group, int begin, int end) const {
    const int last = kTile > 2 ? packs_to(variable(group) + 1) : packs(group);
    return {begin, std::max(begin, std::min(last, end))};
  }

  int groups_, missing_;
  std::vector<std::size_t> forms_;
};

}  // namespace snapspace::online
