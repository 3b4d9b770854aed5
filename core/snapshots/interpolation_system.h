#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "energy/blended_energy.h"
#include "mesh/locality.h"
#include "patches/tet_sample.h"
#include "snapshots/sample_system.h"

namespace snapspace {

/// An interpolation problem: F(u) = sum_k w_k E_k, with u the displacement from pose 0. The inputs
/// of a sample are its weights.
/// F does not change under rigid motions. Its gradient is orthogonal to translations and rotations
/// of the shape, so the iterates drift along them only by rounding, and callers register the
/// results. The null space of the scalar matrix consists of the translations. The matrix is made
/// regular at one vertex: for right-hand sides that sum to zero, as gradients do, that changes the
/// solution only by a translation.
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
  /// poses). Poses that stretch a tet much make it stiff; with an inverse that accounts for this,
  /// solves take a quarter of the iterations.
  [[nodiscard]] InterpolationSystem adapted(const std::vector<double>& shapes,
                                            const std::vector<double>& weights) const;

  [[nodiscard]] int size() const override { return energy->size(); }
  [[nodiscard]] int input_size() const override { return energy->poses(); }
  [[nodiscard]] int inverted_tets(const double* u) const override {
    return energy->energy(0).inverted_tets(u);
  }

  /// Solves along soft modes are long, and a longer memory shortens them. With four pairs instead
  /// of two, blends of four Lions take 136 instead of 148 evaluations, of ten Lions 172 instead of
  /// 197, and of four Lions as surfaces 68 instead of 81. A scaled seed lengthens them.
  [[nodiscard]] LbfgsMemory memory() const override { return kLongMemory; }

  [[nodiscard]] LaneObjectives lanes() const override;
  [[nodiscard]] const RigidPatches* patches() const override { return patches_.rigid.get(); }
  void add_to(PatchHessian& hessian, const double* weights, const double* u) const override;
  [[nodiscard]] std::unique_ptr<LaneObjective<double>> objective() const override;
  [[nodiscard]] BlockHessian hessian_pattern() const override {
    return BlockHessian(energy->energy(0));
  }
  void assemble(const double* input, const double* u, const HessianOptions& options,
                BlockHessian& hessian) const override;

 private:
  struct Patches {  // shared like the energy; null if there are none
    std::shared_ptr<const RigidPatches> rigid;
    std::shared_ptr<const TetSample> tets;  // for solids
  };
  struct Seed {
    Patches patches;
    std::optional<ScalarInverse> scalar;
  };
  static Patches patches_of(const BlendedEnergy& energy, const std::vector<double>& poses);
  /// Patches, and the inverse near the first pose.
  static Seed seed_of(const BlendedEnergy& energy, const std::vector<double>& poses);

  InterpolationSystem(Numbering numbers, std::shared_ptr<const BlendedEnergy> blended,
                      std::vector<std::int32_t> tets, const std::vector<double>& poses);
  InterpolationSystem(Numbering numbers, std::shared_ptr<const BlendedEnergy> blended,
                      std::vector<std::int32_t> tets, Seed seed);

  Patches patches_;
};

}  // namespace snapspace
