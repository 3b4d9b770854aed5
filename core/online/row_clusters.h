#pragma once

namespace snapspace::online {

/// Clusters of tets, each with its own few coordinates y = modes q, which its displacement
/// gradients are linear in. Tets of a cluster follow each other.
struct RowClusters {
  /// Numbers of tets are multiples of this, except that of the last cluster.
  static constexpr int kTets = 8;

  int count = 0;                 ///< 0 if displacement gradients are linear maps of q itself
  const int* sizes = nullptr;    ///< count x 2: numbers of tets and of local coordinates (rank)
  const float* modes = nullptr;  ///< one cluster after the other, rank x dimension
};

}  // namespace snapspace::online
