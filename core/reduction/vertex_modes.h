#pragma once
#include <cstddef>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"

namespace snapspace {

/// Modes of a shape, vertex by vertex: the entries of all modes for a tet are in four places.
class VertexModes {
 public:
  using Wide = Lanes<kWideLanes>;

  /// @param modes  (dimension + 1) x shape_size row-major: an offset, then the basis. In this class
  ///               the offset comes last.
  VertexModes(const double* modes, int dimension, std::size_t shape_size)
      : packs_(dimension / kWideLanes + 1), entries_(shape_size * packs_, Wide(0.0)) {
    for (int k = 0; k <= dimension; ++k) {
      const double* mode = modes + (k < dimension ? k + 1 : 0) * shape_size;
      for (std::size_t i = 0; i < shape_size; ++i)
        entries_[i * packs_ + k / kWideLanes].set(k % kWideLanes, mode[i]);
    }
  }

  /// Packs of modes; lanes after the last mode are zero.
  [[nodiscard]] int packs() const { return packs_; }
  /// x of all modes at a vertex, then y and z.
  [[nodiscard]] const Wide* at(int vertex) const {
    return &entries_[3 * static_cast<std::size_t>(vertex) * packs_];
  }

 private:
  int packs_;
  StreamedVector<Wide> entries_;
};

}  // namespace snapspace
