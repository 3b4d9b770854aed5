#pragma once
#include <memory>
#include <vector>

#include "energy/blended_energy.h"
#include "mesh/locality.h"
#include "snapshots/sample_system.h"

namespace snapspace {

/// An interpolation problem: F(u) = sum_k w_k E_k, with u the displacement from pose 0. The inputs
/// of a sample are its weights.
///
/// F does not change under rigid motions. Its gradient is orthogonal to translations and rotations
/// of the shape, so the iterates only drift along them by rounding, and callers register the
/// results. The scalar matrix has the translations as its null space. It is made regular at one
/// vertex: for right-hand sides that sum to zero, as gradients do, that changes its inverse by
/// translations only.
class InterpolationSystem final : public SampleSystem {
 public:
  std::shared_ptr<const BlendedEnergy> energy;  ///< shared by the systems made by `adapted`
  std::vector<std::int32_t> tet_order;          ///< the caller's number of every tet

  /// @param mesh   pose 0, renumbered
  /// @param poses  count x n x 3 in the internal numbering
  InterpolationSystem(const LocalMesh& mesh, const std::vector<double>& poses, int count,
                      const MaterialField& material);

  /// The same problem with an inverse for solutions near the given shapes (count x 3n, internal
  /// displacements): that of the mean of their scalar Hessians, each at its weights (count x
  /// poses). Poses that stretch a tet much make it stiff, and one that knows needs a fourth of the
  /// iterations.
  [[nodiscard]] InterpolationSystem adapted(const std::vector<double>& shapes,
                                            const std::vector<double>& weights) const;

  [[nodiscard]] int size() const override { return energy->size(); }
  [[nodiscard]] int input_size() const override { return energy->poses(); }
  [[nodiscard]] int inverted_tets(const double* u) const override {
    return energy->energy(0).inverted_tets(u);
  }

  /// Long solves along soft modes, which a longer memory shortens: on the Lion it is 127
  /// iterations, 146 with one pair, 141 with two and a scaled seed; on the helix 240, 282 and 242.
  [[nodiscard]] LbfgsMemory memory() const override { return kLongMemory; }

  [[nodiscard]] LaneObjectives lanes() const override;
  [[nodiscard]] std::unique_ptr<LaneObjective<double>> objective() const override;
  [[nodiscard]] BlockHessian hessian_pattern() const override {
    return BlockHessian(energy->energy(0).rest);
  }
  void assemble(const double* input, const double* u, const HessianOptions& options,
                BlockHessian& hessian) const override;

 private:
  InterpolationSystem(Numbering numbers, std::shared_ptr<const BlendedEnergy> blended,
                      std::vector<std::int32_t> tets);
  InterpolationSystem(Numbering numbers, std::shared_ptr<const BlendedEnergy> blended,
                      std::vector<std::int32_t> tets, ScalarInverse scalar);
};

}  // namespace snapspace
