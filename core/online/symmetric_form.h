#pragma once
#include <algorithm>
#include <cstddef>

#include "online/aligned_array.h"
#include "simd/memory.h"
#include "simd/unrolled.h"

namespace snapspace::online {

/// Ones followed by zeros; a window of Width of them is a mask of the first lanes of a pack.
template <int Width>
struct FirstLanes {
  double ones[2 * Width] = {};
  constexpr FirstLanes() {
    for (int i = 0; i < Width; ++i) ones[i] = 1.0;
  }
};
template <int Width>
inline constexpr FirstLanes<Width> kFirstLanes;

/// The variables x of forms sum_{i <= j} form_ij x_i x_j, arranged for their gradients: in square
/// tiles of rows j and columns i; the tiles on the diagonal are triangles.
template <int Width>
class FormVariables {
 public:
  explicit FormVariables(int capacity)
      : zero_index_(padded(capacity)),
        x_(zero_index_ + 1),
        rows_(Width * x_.size()),
        columns_(rows_.size()) {}

  static constexpr int padded(int count) { return (count + Width - 1) / Width * Width; }

  /// Sets x (n); the padding after it becomes zero.
  void set(const double* x, int n) {
    std::fill(std::copy_n(x, n, x_.data()), x_.data() + padded(n), 0.0);
    const Lanes<Width> zero(0.0);
    for (int j = 0; j < padded(n); ++j) {
      const int lane = j % Width;
      const Lanes<Width> mask = load<Width>(kFirstLanes<Width>.ones + Width - 1 - lane);
      store(&rows_[j * Width], select(mask, Lanes<Width>(x_[j]), zero));
      store(&columns_[j * Width], select(mask, load<Width>(&x_[j - lane]), zero));
    }
  }

  [[nodiscard]] const double* x() const { return x_.data(); }
  /// Index of a variable that is always zero.
  [[nodiscard]] int zero_index() const { return zero_index_; }
  /// x_j in the lanes i <= j of the last tile of row j; 0 in the others.
  [[nodiscard]] Lanes<Width> row(int j) const { return load<Width>(&rows_[j * Width]); }
  /// x_i in the same lanes; 0 in the others.
  [[nodiscard]] Lanes<Width> column(int j) const { return load<Width>(&columns_[j * Width]); }

 private:
  int zero_index_;
  AlignedArray<double> x_, rows_, columns_;
};

/// gradients[f] += the gradient of form f, with rows j = 0 ... last, by x_0 ... x_last, f < Forms.
/// Row j, i <= j, adds row * x_j to entries i of the gradient, and row . x to entry j. Width rows
/// are processed at once: their sums stay in registers, and are added up together. The last row,
/// times zero, stands in for missing ones, which is faster than a branch.
/// @param row        row(f, j) is the address of row j; the padding after it up to the next
///                   multiple of Width is read, and must be finite
/// @param gradients  entries after `last` up to the next multiple of Width are undefined afterwards
template <int Forms, int Width, class Row>
inline void add_form_gradients(Row&& row, int last, const FormVariables<Width>& x,
                               double* const* gradients) {
  for (int block = 0; block <= last; block += Width) {
    std::ptrdiff_t rows[Width];
    const double* forms[Forms];
    int variables[Width];
    Lanes<Width> dots[Forms * Width], factors[Width], entries[Forms];
    unrolled<0, Forms>([&](auto f) { forms[f] = row(f, block); });
    unrolled<0, Width>([&](auto r) {
      const int j = block + r;
      rows[r] = row(0, std::min(j, last)) - forms[0];
      variables[r] = j <= last ? j : x.zero_index();
      factors[r] = Lanes<Width>(x.x()[variables[r]]);
    });
    unrolled<0, Forms * Width>([&](auto i) { dots[i] = Lanes<Width>(0.0); });
    for (int i = 0; i < block; i += Width) {
      const Lanes<Width> x_i = load<Width>(x.x() + i);
      unrolled<0, Forms>([&](auto f) { entries[f] = load<Width>(gradients[f] + i); });
      unrolled<0, Width>([&](auto r) {
        unrolled<0, Forms>([&](auto f) {
          Lanes<Width> entry = load<Width>(forms[f] + rows[r] + i);
          keep_in_register(entry);
          dots[f * Width + r] += entry * x_i;
          entries[f] += entry * factors[r];
        });
      });
      unrolled<0, Forms>([&](auto f) { store(gradients[f] + i, entries[f]); });
    }
    unrolled<0, Forms>([&](auto f) { entries[f] = load<Width>(gradients[f] + block); });
    unrolled<0, Width>([&](auto r) {
      const Lanes<Width> x_row = x.row(variables[r]), x_column = x.column(variables[r]);
      unrolled<0, Forms>([&](auto f) {
        const Lanes<Width> entry = load<Width>(forms[f] + rows[r] + block);
        dots[f * Width + r] += entry * x_column;
        entries[f] += entry * x_row;
      });
    });
    double sums[Forms * Width];
    lane_sums<Forms * Width>(dots, sums);
    unrolled<0, Forms>(
        [&](auto f) { store(gradients[f] + block, entries[f] + load<Width>(sums + f * Width)); });
  }
}

}  // namespace snapspace::online
