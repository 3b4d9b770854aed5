#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"

namespace snapspace {

/// Eight deformations V (3n x 8), entry by entry, for the low-rank part of a seed.
class EightModes {
 public:
  static constexpr int kCount = 8;
  template <class Real>
  using Coordinates = std::array<Sum<Real>, kCount>;

  explicit EightModes(StreamedVector<float> entries) : entries_(std::move(entries)) {}

  [[nodiscard]] std::size_t size() const { return entries_.size() / kCount; }
  [[nodiscard]] double entry(std::size_t i, int k) const { return entries_[i * kCount + k]; }

  // Not inlined: soft modes and coarse spaces share the loops, which every level of the processor
  // and every width has once.

  /// V^T vector.
  template <class Real>
  [[nodiscard, gnu::noinline]] Coordinates<Real> products(const Real* vector) const {
    Coordinates<Real> result;
    result.fill(Sum<Real>(0.0));
    for (std::size_t begin = 0; begin < size(); begin += kChunk) {
      Real sums[kCount];
      for (Real& sum : sums) sum = Real(0);
      for (std::size_t i = begin; i < std::min(size(), begin + kChunk); ++i)
        for (int k = 0; k < kCount; ++k) sums[k] += Real(entries_[i * kCount + k]) * vector[i];
      for (int k = 0; k < kCount; ++k) result[k] += widened(sums[k]);
    }
    return result;
  }

  /// vector += V coordinates.
  template <class Real>
  [[gnu::noinline]] void add(const Coordinates<Real>& coordinates, Real* vector) const {
    Real along[kCount];
    for (int k = 0; k < kCount; ++k) along[k] = cast<typename Real::Scalar>(coordinates[k]);
    for (std::size_t i = 0; i < size(); ++i) {
      const float* entry = &entries_[i * kCount];
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

  StreamedVector<float> entries_;
};

}  // namespace snapspace
