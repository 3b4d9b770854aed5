#pragma once
#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "polish/coarse_space.h"
#include "simd/lanes.h"
#include "snapshots/pair_products.h"

namespace snapspace {

/// The lowest shape that a solve has evaluated so far: what is left of one that is cancelled.
struct LowestShape {
  std::vector<double> shape;  ///< empty before the first finite value
  double value = std::numeric_limits<double>::infinity();
  int evaluations = 0;
};

template <class System, class Real>
class TwoLevelObjective;

/// One sample of a system, in lane 0, with the seed A^{-1} + U B U^T of a two-level additive method
/// (Dryja & Widlund 1990): the scalar factor A for what is local, and the inverse Hessian B on a
/// subspace for what is soft and smooth, which A mistakes for stiff.
template <class System>
struct TwoLevelSystem {
  template <class Real>
  using Objective = TwoLevelObjective<System, Real>;

  /// B has the right scale already.
  static constexpr LbfgsMemory kMemory{.pairs = 2, .scaled = false};

  const System& system;
  const CoarseSpace& coarse;
  const Eigen::MatrixXf& inverse;  ///< B
  LowestShape& lowest;

  [[nodiscard]] std::vector<float> masses() const { return system.masses(); }
};

template <class System, class Real>
class TwoLevelObjective {
 public:
  TwoLevelObjective(const TwoLevelSystem<System>& two_level, int threads)
      : two_level_(two_level),
        objective_(two_level.system, threads),
        vector_(objective_.size()),
        correction_(objective_.size()) {}

  [[nodiscard]] int size() const { return objective_.size(); }
  [[nodiscard]] double negligible() const { return objective_.negligible(); }
  void load(int lane, const double* input) { objective_.load(lane, input); }

  template <class Visitor>
  auto value_and_gradient(const Real* u, Real* gradient, Visitor&& visitor) {
    const auto value = objective_.value_and_gradient(u, gradient, visitor);
    LowestShape& lowest = two_level_.lowest;
    ++lowest.evaluations;
    if (value[0] < lowest.value) {
      lowest.value = value[0];
      lowest.shape.resize(static_cast<std::size_t>(size()));
      for (int i = 0; i < size(); ++i) lowest.shape[i] = u[i][0];
    }
    return value;
  }

  /// `vector` and `result` may be the same array; the other lanes hold nothing. Returns
  /// vector . result.
  template <class Any>
  Sum<Any> precondition(const Any* vector, Any* result) {
    for (int i = 0; i < size(); ++i) vector_[i] = static_cast<float>(vector[i][0]);
    two_level_.coarse.solve(two_level_.inverse, vector_, correction_);
    Sum<Any> product = objective_.precondition(vector, result);
    for (int i = 0; i < size(); ++i) result[i].set(0, result[i][0] + correction_[i]);
    product.set(0, product[0] + vector_.cast<double>().dot(correction_.cast<double>()));
    return product;
  }

 private:
  const TwoLevelSystem<System>& two_level_;
  typename System::template Objective<Real> objective_;
  Eigen::VectorXf vector_, correction_;
};

}  // namespace snapspace
