#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"

namespace snapspace {

/// The coarse part V B V^T of a two-level additive preconditioner (Dryja & Widlund 1990), for all
/// lanes at once: V are deformations that the scalar factor mistakes for stiff, B is diagonal.
class SoftModes {
 public:
  static constexpr int kCount = 8;

  /// @param modes    3n x kCount, entry by entry, in a system's internal numbering
  /// @param weights  the diagonal of B
  SoftModes(StreamedVector<float> modes, const double (&weights)[kCount])
      : modes_(std::move(modes)) {
    std::copy_n(weights, kCount, weights_);
  }

  [[nodiscard]] std::size_t size() const { return modes_.size() / kCount; }
  [[nodiscard]] double weight(int k) const { return weights_[k]; }
  [[nodiscard]] double entry(std::size_t i, int k) const { return modes_[i * kCount + k]; }

  /// The correction of a vector (3n).
  template <class Real>
  struct Correction {
    Sum<Real> coordinates[kCount];  ///< B V^T vector
    Sum<Real> product{0.0};         ///< vector . V B V^T vector
  };
  template <class Real>
  [[nodiscard]] Correction<Real> correction(const Real* vector) const {
    Correction<Real> result;
    for (Sum<Real>& sum : result.coordinates) sum = 0.0;
    for (std::size_t begin = 0; begin < size(); begin += kChunk) {
      Real sums[kCount];
      for (Real& sum : sums) sum = Real(0);
      for (std::size_t i = begin; i < std::min(size(), begin + kChunk); ++i)
        for (int k = 0; k < kCount; ++k) sums[k] += Real(modes_[i * kCount + k]) * vector[i];
      for (int k = 0; k < kCount; ++k) result.coordinates[k] += widened(sums[k]);
    }
    for (int k = 0; k < kCount; ++k) {
      const Sum<Real> along = result.coordinates[k];
      result.coordinates[k] = Sum<Real>(weights_[k]) * along;
      result.product += result.coordinates[k] * along;
    }
    return result;
  }

  /// vector += V coordinates.
  template <class Real>
  void add(const Correction<Real>& correction, Real* vector) const {
    Real along[kCount];
    for (int k = 0; k < kCount; ++k)
      along[k] = cast<typename Real::Scalar>(correction.coordinates[k]);
    for (std::size_t i = 0; i < size(); ++i) {
      const float* entry = &modes_[i * kCount];
      Real even = vector[i], odd(0);
      for (int k = 0; k < kCount; k += 2) {
        even += Real(entry[k]) * along[k];
        odd += Real(entry[k + 1]) * along[k + 1];
      }
      vector[i] = even + odd;
    }
  }

 private:
  /// How many entries' products are summed in the vector's own precision.
  static constexpr std::size_t kChunk = 96;

  StreamedVector<float> modes_;
  double weights_[kCount];
};

}  // namespace snapspace
