#pragma once
#include <cstddef>
#include <vector>

#include "simd/lanes.h"

namespace snapspace::online {

/// The linear map from reduced coordinates q (d) to a cluster's local coordinates y (rank), and its
/// transpose for forces. Entries are rounded as those of TetRows are.
class LocalModes {
 public:
  static constexpr int kWidth = kWideLanes;
  using Pack = Lanes<kWidth>;

  /// No local coordinates.
  LocalModes() = default;
  /// @param modes  rank x dimension
  LocalModes(int dimension, int rank, const float* modes);

  /// How many words one of the products reads.
  [[nodiscard]] std::size_t size() const { return words_.size() * kWidth; }

  /// y = modes q. Reads the first 2 * pairs entries of q, and writes packs of y: twins() * 2.
  void multiply(int pairs, const double* q, Pack* y) const;
  /// Adds modes^T f to `sums` (2 * pairs), whose lanes are summed in the end.
  void add_transposed(int pairs, const Pack* f, Pack* sums) const;
  /// The entries of the first coordinates, rank x dimension.
  void unpack(int rank, int dimension, double* modes) const;

  /// Local coordinates are in pairs of packs; those beyond the rank are zero.
  [[nodiscard]] int twins() const { return twins_; }

 private:
  int pairs_ = 0, twins_ = 0;
  std::vector<Pack> words_;  // twin, pair of coordinates, pack
};

}  // namespace snapspace::online
