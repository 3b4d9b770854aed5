#pragma once
#include <cstddef>

#include "bindings/arrays.h"
#include "live/live_loop.h"

namespace snapspace {

/// Displacement gradients of tets, linear in all coordinates or in those of clusters; refers to its
/// arrays.
class TetRows {
 public:
  /// @param rows  tets x 9 x d
  /// @throws std::invalid_argument  if the sizes do not match
  explicit TetRows(SingleTensorIn rows)
      : arrays_{static_cast<int>(rows.shape(2)), static_cast<int>(rows.shape(0)), rows.data(), {}},
        dense_(rows) {
    require(rows.shape(0) >= 1 && rows.shape(1) == 9 && rows.shape(2) >= 1,
            "rows must be (tets, 9, d)");
  }

  /// @param sizes  clusters x 2: numbers of tets and of local coordinates
  /// @param rows  one cluster after the other, tets x 9 x rank
  /// @param modes  one cluster after the other, rank x d
  /// @throws std::invalid_argument  if the sizes do not match
  TetRows(IndexMatrixIn sizes, SingleVectorIn rows, SingleMatrixIn modes)
      : sizes_(sizes), rows_(rows), modes_(modes) {
    require(sizes.shape(0) >= 1 && sizes.shape(1) == 2 && modes.shape(1) >= 1,
            "sizes must be (clusters, 2) and modes (ranks, d)");
    constexpr auto kMismatch =
        "rows (tets * 9 * rank of all clusters) and modes (ranks, d) do not match the sizes";
    std::size_t numbers = 0, ranks = 0, tets = 0;
    for (std::size_t c = 0; c < sizes.shape(0); ++c) {
      const int own = sizes(c, 0), rank = sizes(c, 1);
      require(own >= 1 && rank >= 1, "clusters must have tets and local coordinates");
      require(own % online::RowClusters::kTets == 0 || c + 1 == sizes.shape(0),
              "only the last cluster may have a number of tets that is no multiple of 8");
      ranks += static_cast<std::size_t>(rank);
      tets += static_cast<std::size_t>(own);
      // Products of damaged sizes might overflow.
      require(ranks <= modes.shape(0) && tets <= rows.size(), kMismatch);
      numbers += 9 * static_cast<std::size_t>(own) * static_cast<std::size_t>(rank);
    }
    require(rows.size() == numbers && modes.shape(0) == ranks, kMismatch);
    arrays_ = {static_cast<int>(modes.shape(1)),
               static_cast<int>(tets),
               rows.data(),
               {static_cast<int>(sizes.shape(0)), sizes.data(), modes.data()}};
  }

  [[nodiscard]] const live::RowArrays& arrays() const { return arrays_; }

 private:
  live::RowArrays arrays_{};
  SingleTensorIn dense_;
  IndexMatrixIn sizes_;
  SingleVectorIn rows_;
  SingleMatrixIn modes_;
};

}  // namespace snapspace
