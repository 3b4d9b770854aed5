#pragma once
#include <memory>
#include <utility>
#include <vector>

#include "energy/block_hessian.h"
#include "patches/rigid_patches.h"
#include "snapshots/numbering.h"
#include "snapshots/pair_products.h"
#include "snapshots/scalar_inverse.h"

namespace snapspace {

/// How Newton's method assembles Hessians.
struct HessianOptions {
  Projection projection = Projection::clamp;
  double threshold = 0.65;  ///< for Projection::stretches; the paper uses 0.5 to 0.8
};

class PatchHessian;
template <class Real>
class LaneObjective;
class LaneObjectives;

/// The parts of a problem that all samples share. Only the inputs differ from sample to sample, and
/// one inverse preconditions them all. Shapes are displacements (3n) in the internal numbering.
class SampleSystem {
 public:
  Numbering numbering;
  ScalarInverse inverse;  ///< of a scalar matrix near the Hessian

  virtual ~SampleSystem() = default;
  SampleSystem(const SampleSystem&) = default;
  SampleSystem(SampleSystem&&) = default;

  [[nodiscard]] virtual int size() const = 0;
  /// How many numbers the input of a sample has.
  [[nodiscard]] virtual int input_size() const = 0;
  /// Number of tets whose orientation differs from that in the rest shape, or in the first pose.
  [[nodiscard]] virtual int inverted_tets(const double* u) const = 0;
  /// The memory that L-BFGS uses.
  [[nodiscard]] virtual LbfgsMemory memory() const = 0;
  /// Objectives for L-BFGS; they refer to this system.
  [[nodiscard]] virtual LaneObjectives lanes() const = 0;
  /// The objective of a single sample.
  [[nodiscard]] virtual std::unique_ptr<LaneObjective<double>> objective() const = 0;
  /// The objective at u (3n) for an input. Its gradient overwrites `gradient`.
  double value_and_gradient(const double* input, const double* u, double* gradient) const;
  /// Patches whose rigid motions are soft; null where the scalar matrix suffices.
  [[nodiscard]] virtual const RigidPatches* patches() const { return nullptr; }
  /// Adds the energy of the sample with this input, at the shape of the Hessian, u.
  virtual void add_to(PatchHessian& /*hessian*/, const double* /*input*/,
                      const double* /*u*/) const {}
  [[nodiscard]] virtual BlockHessian hessian_pattern() const = 0;
  /// The Hessian at u of the sample with this input.
  virtual void assemble(const double* input, const double* u, const HessianOptions& options,
                        BlockHessian& hessian) const = 0;

 protected:
  SampleSystem(Numbering numbers, ScalarInverse scalar)
      : numbering(std::move(numbers)), inverse(std::move(scalar)) {}
};

}  // namespace snapspace
