#pragma once
#include <cstddef>

#include "bindings/arrays.h"
#include "live/live_loop.h"

namespace snapspace {

/// Displacement gradients of tets in clusters with local coordinates; refers to its arrays.
struct LocalRows {
  IndexMatrixIn sizes;   ///< clusters x 2: numbers of tets and of local coordinates
  SingleVectorIn rows;   ///< one cluster after the other, tets x 9 x rank
  SingleMatrixIn modes;  ///< one cluster after the other, rank x d

  /// @throws std::invalid_argument  if the sizes do not match
  LocalRows(IndexMatrixIn sizes_in, SingleVectorIn rows_in, SingleMatrixIn modes_in)
      : sizes(sizes_in), rows(rows_in), modes(modes_in) {
    require(sizes.shape(0) >= 1 && sizes.shape(1) == 2 && modes.shape(1) >= 1,
            "sizes must be (clusters, 2) and modes (ranks, d)");
    constexpr auto kMismatch =
        "rows (tets * 9 * rank of all clusters) and modes (ranks, d) do not match the sizes";
    std::size_t numbers = 0, ranks = 0;
    for (std::size_t c = 0; c < sizes.shape(0); ++c) {
      const int own = sizes(c, 0), rank = sizes(c, 1);
      require(own >= 1 && rank >= 1, "clusters must have tets and local coordinates");
      require(own % live::ClusterArrays::kTets == 0 || c + 1 == sizes.shape(0),
              "only the last cluster may have a number of tets that is no multiple of 8");
      ranks += static_cast<std::size_t>(rank);
      tets += static_cast<std::size_t>(own);
      // Products of damaged sizes might overflow.
      require(ranks <= modes.shape(0) && tets <= rows.size(), kMismatch);
      numbers += 9 * static_cast<std::size_t>(own) * static_cast<std::size_t>(rank);
    }
    require(rows.size() == numbers && modes.shape(0) == ranks, kMismatch);
  }

  [[nodiscard]] std::size_t dimension() const { return modes.shape(1); }
  [[nodiscard]] live::ClusterArrays clusters() const {
    return {static_cast<int>(sizes.shape(0)), sizes.data(), modes.data()};
  }

  std::size_t tets = 0;
};

}  // namespace snapspace
