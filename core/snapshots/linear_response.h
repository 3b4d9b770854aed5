#pragma once
#include <cstddef>

#include "memory/streamed_vector.h"
#include "snapshots/posing_system.h"

namespace snapspace {

/// The displacements of a posing problem, linearised at rest, for small displacements of its
/// handles: the solutions of H r = 2 weights * target with the Hessian H at rest, in single
/// precision and to a few tenths of a percent of their energy.
class LinearResponse {
 public:
  /// @param inputs  count x input_size(), target displacements of the pinned vertices
  LinearResponse(const PosingSystem& system, const double* inputs, int count);

  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] std::size_t size() const { return entries_.size() / count_; }
  /// Entry i, in the internal numbering, of the response to input k.
  [[nodiscard]] float entry(std::size_t i, int k) const { return entries_[i * count_ + k]; }

 private:
  int count_;
  StreamedVector<float> entries_;
};

}  // namespace snapspace
