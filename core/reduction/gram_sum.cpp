#include "reduction/gram_sum.h"

#include <algorithm>
#include <cstring>

namespace snapspace {

namespace {

/// Index of a pair of groups I <= J.
std::size_t pair_of(int I, int J) { return static_cast<std::size_t>(J) * (J + 1) / 2 + I; }

}  // namespace

GramSum::GramSum(int columns, int rows)
    : columns_(columns),
      rows_(rows),
      groups_((columns + kGroup - 1) / kGroup),
      panel_(static_cast<std::size_t>(groups_) * rows * kPacks, Wide(0.0)),
      sums_(pair_of(0, groups_) * kGroup * kPacks, Wide(0.0)) {}

void GramSum::set_row(int r, const double* row) {
  for (int group = 0; group < groups_; ++group) {
    Wide* to = &panel_[(static_cast<std::size_t>(group) * rows_ + r) * kPacks];
    const int count = std::min(kGroup, columns_ - group * kGroup);
    std::memcpy(static_cast<void*>(to), row + group * kGroup, count * sizeof(double));
  }
}

void GramSum::add(int rows) {
  const auto panel_of = [&](int group) {
    return &panel_[static_cast<std::size_t>(group) * rows_ * kPacks];
  };
  for (int J = 0; J < groups_; ++J)
    for (int I = 0; I <= J; ++I)
      for (int c = 0; c < kGroup; c += kTileColumns)
        add_tile(reinterpret_cast<const double*>(panel_of(I)) + c, panel_of(J), rows,
                 &sums_[(pair_of(I, J) * kGroup + c) * kPacks]);
}

void GramSum::add(const GramSum& other) {
  for (std::size_t k = 0; k < sums_.size(); ++k) sums_[k] += other.sums_[k];
}

void GramSum::add_tile(const double* row, const Wide* other, int rows, Wide* sums) {
  Wide tile[kTileColumns][kPacks];
#pragma GCC unroll 8
  for (int c = 0; c < kTileColumns; ++c)
#pragma GCC unroll 3
    for (int p = 0; p < kPacks; ++p) tile[c][p] = Wide(0.0);
  for (int r = 0; r < rows; ++r, row += kGroup, other += kPacks) {
#pragma GCC unroll 8
    for (int c = 0; c < kTileColumns; ++c) {
      const Wide factor(row[c]);
#pragma GCC unroll 3
      for (int p = 0; p < kPacks; ++p) tile[c][p] += factor * other[p];
    }
  }
#pragma GCC unroll 8
  for (int c = 0; c < kTileColumns; ++c)
#pragma GCC unroll 3
    for (int p = 0; p < kPacks; ++p) sums[c * kPacks + p] += tile[c][p];
}

double GramSum::at(int a, int b) const {
  const std::size_t row = pair_of(a / kGroup, b / kGroup) * kGroup + a % kGroup;
  const int place = b % kGroup;
  return sums_[row * kPacks + place / kWideLanes][place % kWideLanes];
}

}  // namespace snapspace
