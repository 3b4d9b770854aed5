#include "snapshots/mode_block.h"

namespace snapspace {

void ModeBlock::add_products(const ModeBlock& other, std::size_t begin, std::size_t end,
                             SquareMatrix& all, int row, int column) const {
  for (int p = 0; p < kPacks; ++p)
    for (int q = 0; q < kPacks; ++q) {
      const auto* lefts = reinterpret_cast<const float*>(pack(p));
      const Pack* rights = other.pack(q);
      Pack sums[kLanes];
#pragma GCC unroll 8
      for (int k = 0; k < kLanes; ++k) sums[k] = Pack(0);
      for (std::size_t i = begin; i < end; ++i) {
        const Pack right = rights[i];
#pragma GCC unroll 8
        for (int k = 0; k < kLanes; ++k) sums[k] += Pack(lefts[i * kLanes + k]) * right;
      }
      for (int k = 0; k < kLanes; ++k)
        for (int j = 0; j < kLanes; ++j)
          all(row + p * kLanes + k, column + q * kLanes + j) += sums[k][j];
    }
}

void ModeBlock::combine(const std::vector<double>& coefficients, const ModeBlock& fresh,
                        ModeBlock& past) {
  Pack rows[3 * kColumns][kPacks];
  for (int k = 0; k < 3 * kColumns; ++k)
    for (int j = 0; j < kColumns; ++j)
      set_lane(rows[k][j / kLanes], j % kLanes, coefficients[j * 3 * kColumns + k]);
  const auto add = [&](const ModeBlock& block, int first, std::size_t i, Pack* sums) {
    for (int p = 0; p < kPacks; ++p) {
      const auto* entries = reinterpret_cast<const float*>(block.pack(p) + i);
      for (int k = 0; k < kLanes; ++k)
        for (int q = 0; q < kPacks; ++q)
          sums[q] += Pack(entries[k]) * rows[first + p * kLanes + k][q];
    }
  };
  for_parts(size(), [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Pack inside[kPacks], outside[kPacks];
      for (int q = 0; q < kPacks; ++q) inside[q] = outside[q] = Pack(0);
      add(*this, 0, i, inside);
      add(fresh, kColumns, i, outside);
      add(past, 2 * kColumns, i, outside);
      for (int q = 0; q < kPacks; ++q) {
        pack(q)[i] = inside[q] + outside[q];
        past.pack(q)[i] = outside[q];
      }
    }
  });
}

}  // namespace snapspace
