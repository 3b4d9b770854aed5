#pragma once
#include <memory>
#include <vector>

#include "energy/blended_energy.h"
#include "mesh/locality.h"
#include "snapshots/sample_system.h"

namespace snapspace {

/// An interpolation problem: F(u) = sum_k w_k E_k, with u the displacement from pose 0. The inputs
/// of a sample are its weights.
/// F does not change under rigid motions. Its gradient is orthogonal to translations and rotations
/// of the shape, so the iterates drift along them only by rounding, and callers register the
/// results. The null space of the scalar matrix is the translations. It is made regular at one
/// vertex: for right-hand sides that sum to zero, as gradients do, that changes the solution only
/// by a translation.
class InterpolationSystem final : public SampleSystem {
 public:
  std::shared_ptr<const BlendedEnergy> energy;  ///< shared by the systems made by `adapted`
  std::vector<std::int32_t> tet_order;          ///< the caller's index of each tet

  /// @param mesh   pose 0, renumbered
  /// @param poses  count x n x 3 in the internal numbering
  InterpolationSystem(const LocalMesh& mesh, const std::vector<double>& poses, int count,
                      const MaterialField& material);

  /// The same problem with an inverse for solutions near the given shapes (count x 3n, internal
  /// displacements): that of the mean of their scalar Hessians, each at its weights (count x
  /// poses). Poses that stretch a tet much make it stiff; an inverse that accounts for it needs a
  /// quarter of the iterations.
  [[nodiscard]] InterpolationSystem adapted(const std::vector<double>& shapes,
                                            const std::vector<double>& weights) const;

  [[nodiscard]] int size() const override { return energy->size(); }
  [[nodiscard]] int input_size() const override { return energy->poses(); }
  [[nodiscard]] int inverted_tets(const double* u) const override {
    return energy->energy(0).inverted_tets(u);
  }

  /// Solves along soft modes are long, and a longer memory shortens them: the Lion takes 127
  /// iterations, 146 with one pair, 141 with two and a scaled seed; the helix 240, 282 and 242.
  [[nodiscard]] LbfgsMemory memory() const override { return kLongMemory; }

  [[nodiscard]] LaneObjectives lanes() const override;
  [[nodiscard]] const RigidPatches* patches() const override {
    return patches_ && patches_->count() > 0 ? patches_.get() : nullptr;
  }
  void add_to(PatchHessian& hessian, const double* weights) const override;
  [[nodiscard]] std::unique_ptr<LaneObjective<double>> objective() const override;
  [[nodiscard]] BlockHessian hessian_pattern() const override {
    return BlockHessian(energy->energy(0));
  }
  void assemble(const double* input, const double* u, const HessianOptions& options,
                BlockHessian& hessian) const override;

 private:
  InterpolationSystem(Numbering numbers, std::shared_ptr<const BlendedEnergy> blended,
                      std::vector<std::int32_t> tets, std::shared_ptr<const RigidPatches> patches);
  InterpolationSystem(Numbering numbers, std::shared_ptr<const BlendedEnergy> blended,
                      std::vector<std::int32_t> tets, std::shared_ptr<const RigidPatches> patches,
                      ScalarInverse scalar);

  std::shared_ptr<const RigidPatches> patches_;  // shared like the energy
};

}  // namespace snapspace
