#pragma once
#include <vector>

#include "simd/lanes.h"
#include "snapshots/pair_products.h"
#include "snapshots/soft_modes.h"

namespace snapspace {

template <class System, class Real>
class SoftenedObjective;

/// A system with the seed A^{-1} + V B V^T in place of A^{-1}, its scalar factor: the factor for
/// what is local, and a few modes for what is soft and smooth.
template <class System>
struct SoftenedSystem {
  template <class Real>
  using Objective = SoftenedObjective<System, Real>;
  static constexpr LbfgsMemory kMemory = System::kMemory;

  const System& system;
  const SoftModes& modes;

  [[nodiscard]] std::vector<float> masses() const { return system.masses(); }
};

template <class System, class Real>
class SoftenedObjective {
 public:
  SoftenedObjective(const SoftenedSystem<System>& softened, int threads)
      : modes_(softened.modes), objective_(softened.system, threads) {}

  [[nodiscard]] int size() const { return objective_.size(); }
  [[nodiscard]] double negligible() const { return objective_.negligible(); }
  void load(int lane, const double* input) { objective_.load(lane, input); }

  template <class Visitor>
  auto value_and_gradient(const Real* u, Real* gradient, Visitor&& visitor) {
    return objective_.value_and_gradient(u, gradient, visitor);
  }

  /// `vector` and `result` may be the same array. Returns vector . result.
  template <class Any>
  Sum<Any> precondition(const Any* vector, Any* result) {
    const auto correction = modes_.correction(vector);
    const Sum<Any> product = objective_.precondition(vector, result);
    modes_.add(correction, result);
    return product + correction.product;
  }

 private:
  const SoftModes& modes_;
  typename System::template Objective<Real> objective_;
};

}  // namespace snapspace
