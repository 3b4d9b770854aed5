#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "energy/blended_energy.h"
#include "energy/block_hessian.h"
#include "energy/scalar_hessian.h"
#include "mesh/sweep.h"
#include "simd/lanes.h"
#include "snapshots/numbering.h"
#include "snapshots/pair_products.h"
#include "snapshots/scalar_inverse.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

template <class Real>
class InterpolationObjective;

/// What all samples of an interpolation problem share: F(u) = sum_k w_k E_k, with u the
/// displacement from pose 0. Only the weights differ from sample to sample; one inverse
/// preconditions them all.
///
/// F does not change under rigid motions. Its gradient is orthogonal to translations and rotations
/// of the shape, so the iterates only drift along them by rounding, and callers register the
/// results. The scalar matrix has the translations as its null space. It is made regular at one
/// vertex: for right-hand sides that sum to zero, as gradients do, that changes its inverse by
/// translations only.
struct InterpolationSystem {
  template <class Real>
  using Objective = InterpolationObjective<Real>;

  /// Long solves along soft modes, which a longer memory shortens: on the Lion it is 127
  /// iterations, 146 with one pair, 141 with two and a scaled seed; on the helix 240, 282 and 242.
  static constexpr LbfgsMemory kMemory{.pairs = 2, .scaled = false};

  Numbering numbering;
  std::shared_ptr<const BlendedEnergy> energy;  ///< shared by the systems made by `adapted`
  ScalarInverse inverse;

  /// @param mesh   pose 0, renumbered
  /// @param poses  count x n x 3 in the internal numbering
  InterpolationSystem(const LocalMesh& mesh, const std::vector<double>& poses, int count,
                      StVK material)
      : InterpolationSystem(
            Numbering(mesh.order),
            std::make_shared<BlendedEnergy>(poses.data(), count,
                                            static_cast<int>(mesh.order.size()), mesh.tets.data(),
                                            static_cast<int>(mesh.tets.size() / 4), material)) {}

  /// The same problem with an inverse for solutions near the given shapes (count x 3n, internal
  /// displacements): that of the mean of their scalar Hessians at equal weights. Poses that stretch
  /// a tet much make it stiff, and one that knows needs a fourth of the iterations.
  [[nodiscard]] InterpolationSystem adapted(const std::vector<double>& shapes, int count) const {
    return {numbering, energy, inverse.of(scalar_matrix(*energy, shapes, count))};
  }

  [[nodiscard]] int size() const { return energy->size(); }
  [[nodiscard]] int input_size() const { return energy->poses(); }
  [[nodiscard]] double negligible() const { return energy->energy(0).negligible(); }
  /// Weights of the vertices where lengths of displacements are compared.
  [[nodiscard]] std::vector<float> masses() const { return energy->energy(0).rest.lumped_shares(); }

  /// Tets whose orientation differs from the one in pose 0.
  [[nodiscard]] int inverted_tets(const double* u) const {
    return energy->energy(0).inverted_tets(u);
  }

 private:
  InterpolationSystem(Numbering numbers, std::shared_ptr<const BlendedEnergy> blended)
      : InterpolationSystem(
            std::move(numbers), blended,
            ScalarInverse(scalar_matrix(*blended, std::vector<double>(blended->size(), 0.0), 1))) {}

  InterpolationSystem(Numbering numbers, std::shared_ptr<const BlendedEnergy> blended,
                      ScalarInverse scalar)
      : numbering(std::move(numbers)), energy(std::move(blended)), inverse(std::move(scalar)) {}

  [[nodiscard]] static Eigen::SparseMatrix<double> scalar_matrix(const BlendedEnergy& energy,
                                                                 const std::vector<double>& shapes,
                                                                 int count) {
    ScalarHessian hessian(energy.energy(0).rest);
    const int size = energy.size();
    std::vector<double> shifted(size);
    for (int shape = 0; shape < count; ++shape)
      for (int k = 0; k < energy.poses(); ++k) {
        const double* u = shapes.data() + static_cast<std::size_t>(shape) * size;
        for (int i = 0; i < size; ++i) shifted[i] = u[i] + energy.offset(k)[i];
        hessian.add(energy.energy(k), shifted.data(), 1.0 / (count * energy.poses()));
      }
    Eigen::SparseMatrix<double> A = hessian.matrix();
    A.coeffRef(0, 0) *= 2.0;
    return A;
  }
};

/// The objective of the samples that are in the lanes now; see PosingObjective.
template <class Real>
class InterpolationObjective {
 public:
  /// @param threads  that it may use for itself
  explicit InterpolationObjective(const InterpolationSystem& system, int threads = 1)
      : system_(system),
        threads_(threads),
        weights_(system.input_size(), Real(0.0)),
        second_half_(system.size(), Real(0.0)) {}

  [[nodiscard]] int size() const { return system_.size(); }
  [[nodiscard]] double negligible() const { return negligible_; }

  /// The lane takes the weights of a sample (input_size() numbers).
  void load(int lane, const double* weights) {
    for (std::size_t k = 0; k < weights_.size(); ++k) set_lane(weights_[k], lane, weights[k]);
  }

  /// F at u (3n); its gradient overwrites `gradient`, and the visitor sees it whole. Few samples
  /// are a pack or two, which would leave threads idle: the tets are gone through in two halves,
  /// whatever the number of threads and the width of the pack, because sums of other parts would
  /// round differently.
  template <class Visitor = NoVisitor>
  Sum<Real> value_and_gradient(const Real* u, Real* gradient, Visitor&& visitor = {}) {
    visitor.before(0, size() / 3);
    const int tets = system_.energy->tets();
    Sum<Real> values[2];
    parallel_for(2, threads_, [&](int half) {
      const FlushDenormals flush;  // as on the caller's thread
      values[half] = system_.energy->value_and_gradient(
          weights_.data(), u, half == 0 ? gradient : second_half_.data(), half == 0 ? 0 : tets / 2,
          half == 0 ? tets / 2 : tets);
    });
    for (int i = 0; i < size(); ++i) gradient[i] += second_half_[i];
    visitor.after(0, size() / 3);
    return values[0] + values[1];
  }

  template <class Any>
  Sum<Any> precondition(const Any* vector, Any* result) {
    return system_.inverse.apply(vector, result, scratch_);
  }

  [[nodiscard]] BlockHessian hessian_pattern() const {
    return BlockHessian(system_.energy->energy(0).rest);
  }

  /// One lane only: the Hessian at u, clamped as BlockHessian::add does it.
  void assemble(const double* u, double clamp, BlockHessian& hessian) const {
    hessian.clear();
    std::vector<double> shifted(size());
    for (int k = 0; k < system_.energy->poses(); ++k) {
      const std::vector<double>& offset = system_.energy->offset(k);
      for (int i = 0; i < size(); ++i) shifted[i] = u[i] + offset[i];
      hessian.add(system_.energy->energy(k), shifted.data(), clamp, weights_[k]);
    }
  }

 private:
  const InterpolationSystem& system_;
  int threads_;
  std::vector<Real> weights_;
  std::vector<Real> second_half_;  // of the gradient
  double negligible_ = system_.negligible();
  Scratch scratch_;
};

}  // namespace snapspace
