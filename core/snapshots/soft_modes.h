#pragma once
#include <algorithm>
#include <utility>

#include "snapshots/eight_modes.h"

namespace snapspace {

/// The coarse part V B V^T of a two-level additive preconditioner (Dryja & Widlund 1990), for all
/// lanes at once: V are deformations that the scalar factor mistakes for stiff, B is diagonal.
class SoftModes {
 public:
  static constexpr int kCount = EightModes::kCount;

  /// @param modes    V, in a system's internal numbering
  /// @param weights  the diagonal of B
  SoftModes(EightModes modes, const double (&weights)[kCount]) : modes_(std::move(modes)) {
    std::copy_n(weights, kCount, weights_);
  }

  [[nodiscard]] std::size_t size() const { return modes_.size(); }
  [[nodiscard]] double weight(int k) const { return weights_[k]; }
  [[nodiscard]] double entry(std::size_t i, int k) const { return modes_.entry(i, k); }

  /// The correction of a vector (3n).
  template <class Real>
  struct Correction {
    EightModes::Coordinates<Real> coordinates;  ///< B V^T vector
    Sum<Real> product{0.0};                     ///< vector . V B V^T vector
  };
  template <class Real>
  [[nodiscard]] Correction<Real> correction(const Real* vector) const {
    Correction<Real> result{modes_.products(vector)};
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
    modes_.add(correction.coordinates, vector);
  }

 private:
  EightModes modes_;
  double weights_[kCount];
};

}  // namespace snapspace
