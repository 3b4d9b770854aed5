#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "energy/elastic_energy.h"
#include "mesh/locality.h"
#include "snapshots/sample_system.h"

namespace snapspace {

/// A posing problem: F(u) = E(u) + sum_k weight_k |u_k - target_k|^2 over pinned vertices k. The
/// inputs of a sample are its targets.
class PosingSystem final : public SampleSystem {
 public:
  ElasticEnergy energy;
  std::vector<std::int32_t> pinned;  ///< vertices of the handles, internal
  std::vector<double> weights;       ///< stiffness * vertex mass, one per pinned vertex
  std::vector<std::int32_t> pins;    ///< indices into pinned and weights, sorted by vertex

  /// The scalar matrix is (2 mu + lam) * Laplacian + 2 * weights on the diagonal.
  PosingSystem(const LocalMesh& mesh, const MaterialField& material,
               const std::vector<std::int32_t>& pinned_vertices,
               const std::vector<double>& pin_weights, InverseKind kind = InverseKind::automatic);

  [[nodiscard]] int size() const override { return 3 * energy.rest.vertex_count; }
  [[nodiscard]] int input_size() const override { return 3 * static_cast<int>(pinned.size()); }
  [[nodiscard]] int inverted_tets(const double* u) const override {
    return energy.inverted_tets(u);
  }

  /// Handles hold the shape, so its solve is short. At first the material stiffens along every
  /// direction, and a scaled seed adapts to that at once: 48 samples of the Dragon take 48
  /// evaluations each, 57 with two pairs and a fixed seed, 50 with two and a scaled one.
  [[nodiscard]] LbfgsMemory memory() const override { return kShortMemory; }

  [[nodiscard]] LaneObjectives lanes() const override;
  [[nodiscard]] std::unique_ptr<LaneObjective<double>> objective() const override;
  [[nodiscard]] BlockHessian hessian_pattern() const override { return BlockHessian(energy); }
  void assemble(const double* input, const double* u, const HessianOptions& options,
                BlockHessian& hessian) const override;

  /// Hessian of F at rest times v: the elastic forces of small displacements and those of the
  /// handles.
  template <class Real>
  void rest_hessian_product(const Real* v, Real* product) const {
    energy.rest_hessian_product(v, product);
    for (std::size_t k = 0; k < pinned.size(); ++k) {
      const std::size_t at = 3 * static_cast<std::size_t>(pinned[k]);
      const Real weight(static_cast<typename ScalarOf<Real>::type>(2.0 * weights[k]));
      for (int c = 0; c < 3; ++c) product[at + c] += weight * v[at + c];
    }
  }

 private:
  PosingSystem(const LocalMesh& mesh, ElasticEnergy elastic,
               const std::vector<std::int32_t>& pinned_vertices,
               const std::vector<double>& pin_weights, InverseKind kind);
};

}  // namespace snapspace
