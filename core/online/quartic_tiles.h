#pragma once
#include <cstddef>

#include "online/packed_layout.h"
#include "simd/memory.h"
#include "simd/unrolled.h"

/// The loops that read the coefficients of a tile once. `Stored` is double or float. Loops over
/// rows and columns are unrolled: all sums of a tile stay in registers.

namespace snapspace::online {

using Numbers = Lanes<kPack>;

/// The variables of a group, and their quadratic forms in the pairs.
struct FormGroup {
  const double* x;
  double* forms;
  std::size_t size;  // of a form
};

/// The sums of a tile, and the variables of its rows k and columns l.
struct TileSums {
  Numbers forms[kTile * kTile], x_k[kTile], x_l[kTile];

  [[gnu::always_inline]] TileSums(const double* rows, const double* columns) {
    unrolled<0, kTile * kTile>([&](auto i) { forms[i] = Numbers(0.0); });
    unrolled<0, kTile>([&](auto i) {
      x_k[i] = Numbers(rows[i]);
      x_l[i] = Numbers(columns[i]);
    });
  }
};

/// For rows First ... of a tile: forms_kl += sum_p c_kl[p] pairs[p], and in the quadratic forms
/// cubic_k[p] += sum_l x_l c_kl[p] and cubic_l[p] += sum_k x_k c_kl[p].
template <int First, class Stored>
[[gnu::always_inline]] inline void contract_tile(const Stored* from, PairPacks packs,
                                                 const double* pairs, FormGroup k, FormGroup l,
                                                 TileSums& sums) {
  for (int p = packs.begin * kPack; p < packs.end * kPack; p += kPack) {
    const Numbers pair = load<kPack>(pairs + p);
    Numbers rows[kTile];
    unrolled<First, kTile>([&](auto r) { rows[r] = load<kPack>(k.forms + r * k.size + p); });
    unrolled<0, kTile>([&](auto c) {
      Numbers column = load<kPack>(l.forms + c * l.size + p);
      keep_in_register(column);
      unrolled<First, kTile>([&](auto r) {
        Numbers entry = load<kPack>(from);
        from += kPack;
        keep_in_register(entry);
        sums.forms[c * kTile + r] += entry * pair;
        rows[r] += entry * sums.x_l[c];
        column += entry * sums.x_k[r];
      });
      store(l.forms + c * l.size + p, column);
    });
    unrolled<First, kTile>([&](auto r) { store(k.forms + r * k.size + p, rows[r]); });
  }
}

/// The same for a tile on the diagonal, k <= l in one group, which is the first to write its forms.
/// A block on the diagonal counts both as row and as column.
template <int First, class Stored>
[[gnu::always_inline]] inline void contract_diagonal(const Stored* from, PairPacks packs,
                                                     const double* pairs, FormGroup k,
                                                     TileSums& sums) {
  Numbers twice[kTile];
  unrolled<First, kTile>([&](auto r) { twice[r] = sums.x_l[r] + sums.x_l[r]; });
  for (int p = packs.begin * kPack; p < packs.end * kPack; p += kPack) {
    const Numbers pair = load<kPack>(pairs + p);
    Numbers rows[kTile];
    unrolled<First, kTile>([&](auto r) { rows[r] = Numbers(0.0); });
    unrolled<First, kTile>([&](auto c) {
      unrolled<First, c + 1>([&](auto r) {
        Numbers entry = load<kPack>(from);
        from += kPack;
        keep_in_register(entry);
        sums.forms[c * kTile + r] += entry * pair;
        if constexpr (r < c) {
          rows[r] += entry * sums.x_l[c];
          rows[c] += entry * sums.x_l[r];
        } else {
          rows[r] += entry * twice[r];
        }
      });
    });
    unrolled<First, kTile>([&](auto r) { store(k.forms + r * k.size + p, rows[r]); });
  }
}

/// For rows First ... of a tile: forms_kl as above, and weights[p] += sum_kl x_k x_l c_kl[p].
/// @tparam Diagonal  whether only entries with k <= l exist
template <int First, bool Diagonal, class Stored>
[[gnu::always_inline]] inline void contract_pairs(const Stored* from, PairPacks packs,
                                                  const double* pairs, double* weights,
                                                  TileSums& sums) {
  for (int p = packs.begin * kPack; p < packs.end * kPack; p += kPack) {
    const Numbers pair = load<kPack>(pairs + p);
    Numbers weight = load<kPack>(weights + p);
    unrolled<Diagonal ? First : 0, kTile>([&](auto c) {
      constexpr bool kFewRegisters = kTile > 2;  // otherwise each x_k x_l has a register
      Numbers column(0.0);
      unrolled<First, Diagonal ? c + 1 : kTile>([&](auto r) {
        Numbers entry = load<kPack>(from);
        from += kPack;
        keep_in_register(entry);
        sums.forms[c * kTile + r] += entry * pair;
        if constexpr (kFewRegisters)
          column += entry * sums.x_k[r];
        else
          weight += entry * (sums.x_k[r] * sums.x_l[c]);
      });
      if constexpr (kFewRegisters) weight += column * sums.x_l[c];
    });
    store(weights + p, weight);
  }
}

}  // namespace snapspace::online
