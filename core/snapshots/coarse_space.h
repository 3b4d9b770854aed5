#pragma once
#include <cstddef>
#include <vector>

#include "snapshots/eight_modes.h"
#include "snapshots/numbering.h"

namespace snapspace {

/// The basis V of a subspace in single precision and in a system's internal numbering, for the
/// coarse part V B V^T of a two-level preconditioner. The dimension is raised to a multiple of
/// eight by modes that are zero.
class CoarseSpace {
 public:
  /// @param modes  dimension x size, row-major, in the caller's numbering
  CoarseSpace(const Numbering& numbering, const double* modes, int dimension, std::size_t size);

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] std::size_t size() const { return blocks_[0].size(); }
  [[nodiscard]] const std::vector<EightModes>& blocks() const { return blocks_; }

 private:
  int dimension_;
  std::vector<EightModes> blocks_;
};

}  // namespace snapspace
