#pragma once
#include <cstddef>
#include <vector>

#include "dense/symmetric_pencil.h"
#include "memory/streamed_vector.h"
#include "simd/lanes.h"
#include "threads/parallel.h"

namespace snapspace {

/// Sixteen tall columns beside each other, in packs of eight (four without AVX): where columns do
/// not meet, packs can be given to different threads.
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

  /// The block of `all` from (row, column) on += this^T other of the entries from begin to before
  /// end, in single precision: for a few hundred entries.
  void add_products(const ModeBlock& other, std::size_t begin, std::size_t end, SquareMatrix& all,
                    int row, int column) const;

  /// With the coefficients (48 x 16, column by column) of three blocks: this becomes the
  /// combination of all, and `past` that of the other two.
  void combine(const std::vector<double>& coefficients, const ModeBlock& fresh, ModeBlock& past);

 private:
  std::vector<StreamedVector<Pack>> packs_;
};

inline constexpr int kModeParts = 16;

/// Calls work(part, begin, end) for kModeParts parts of the entries, on all threads. Parts do not
/// depend on the number of threads: who adds up what they give has the same sum.
template <class Work>
void for_parts(std::size_t size, Work&& work) {
  parallel_for(kModeParts, 0, [&](int part) {
    work(part, size * part / kModeParts, size * (part + 1) / kModeParts);
  });
}

}  // namespace snapspace
