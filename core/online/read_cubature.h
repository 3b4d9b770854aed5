#pragma once
#include "online/session.h"
#include "online/snapspace_online.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// Whether sizes and pointers of clusters fit a number of tets; with count 0 they do.
inline bool are_clusters(const snapspace_clusters& clusters, int tets) {
  if (clusters.count == 0) return true;
  if (clusters.count < 0 || !clusters.sizes || !clusters.modes) return false;
  int left = tets;
  for (int c = 0; c < clusters.count; ++c) {
    const int own = clusters.sizes[2 * c], rank = clusters.sizes[2 * c + 1];
    const bool full = own % RowClusters::kTets == 0 || c + 1 == clusters.count;
    if (own < 1 || own > left || rank < 1 || !full) return false;
    left -= own;
  }
  return left == 0;
}

inline bool is_cubature(const snapspace_cubature* cubature) {
  return cubature && cubature->tets >= 1 && cubature->rows && cubature->weights &&
         are_clusters(cubature->clusters, cubature->tets);
}

inline RowClusters clusters_of(const snapspace_cubature& cubature) {
  return {cubature.clusters.count, cubature.clusters.sizes, cubature.clusters.modes};
}

}  // namespace snapspace::online
