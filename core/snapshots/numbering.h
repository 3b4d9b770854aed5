#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "mesh/locality.h"

namespace snapspace {

/// Copies shape vectors (3n) between the caller's numbering of the vertices and the internal one
/// (LocalMesh).
class Numbering {
 public:
  explicit Numbering(std::vector<std::int32_t> order) : order_(std::move(order)) {}

  void to_internal(const double* from, double* to) const {
    for (std::size_t v = 0; v < order_.size(); ++v)
      std::copy_n(from + 3 * order_[v], 3, to + 3 * v);
  }
  void to_external(const double* from, double* to) const {
    for (std::size_t v = 0; v < order_.size(); ++v)
      std::copy_n(from + 3 * v, 3, to + 3 * order_[v]);
  }

 private:
  std::vector<std::int32_t> order_;  // the caller's index of each internal vertex
};

}  // namespace snapspace
