#pragma once
#include <cstddef>
#include <vector>

#include "dense/symmetric_pencil.h"
#include "memory/streamed_vector.h"
#include "simd/lanes.h"
#include "threads/parallel.h"

namespace snapspace {

/// Sixteen tall columns side by side, in packs of eight (four without AVX). Where columns do not
/// interact, packs can go to different threads.
class ModeBlock {
 public:
  static constexpr int kColumns = 16;
  static constexpr int kLanes = kWideLanes < 4 ? 2 * kWideLanes : 8;
  static constexpr int kPacks = kColumns / kLanes;
  using Pack = SingleLanes<kLanes>;

  explicit ModeBlock(std::size_t size) : packs_(kPacks, StreamedVector<Pack>(size, Pack(0))) {}

  [[nodiscard]] std::size_t size() const { return packs_[0].size(); }
  [[nodiscard]] Pack* pack(int p) { return packs_[p].data(); }
  [[nodiscard]] const Pack* pack(int p) const { return packs_[p].data(); }
  [[nodiscard]] float at(std::size_t i, int k) const { return packs_[k / kLanes][i][k % kLanes]; }
  void set(std::size_t i, int k, double value) {
    set_lane(packs_[k / kLanes][i], k % kLanes, value);
  }

  /// Adds this^T other, over the entries from begin to before end, to the block of `all` that
  /// begins at (row, column). In single precision: for a few hundred entries.
  void add_products(const ModeBlock& other, std::size_t begin, std::size_t end, SquareMatrix& all,
                    int row, int column) const;

  /// Combines three blocks with coefficients (48 x 16, column by column): this becomes the
  /// combination of all three, and `past` that of the other two.
  void combine(const std::vector<double>& coefficients, const ModeBlock& fresh, ModeBlock& past);

 private:
  std::vector<StreamedVector<Pack>> packs_;
};

inline constexpr int kModeParts = 16;

/// Calls work(part, begin, end) for kModeParts parts of the entries, on all threads. The parts do
/// not depend on the number of threads, so sums over them do not either.
template <class Work>
void for_parts(std::size_t size, Work&& work) {
  parallel_for(kModeParts, 0, [&](int part) {
    work(part, size * part / kModeParts, size * (part + 1) / kModeParts);
  });
}

}  // namespace snapspace
