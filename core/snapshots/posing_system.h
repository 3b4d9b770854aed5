#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "energy/elastic_energy.h"
#include "mesh/locality.h"
#include "snapshots/scalar_factor.h"

namespace snapspace {

/// What all samples of a posing problem share: F(u) = E(u) + sum_k weight_k |u_k - target_k|^2 over
/// pinned vertices k. Only the targets differ from sample to sample, so one factor serves them all.
///
/// Inside, vertices are numbered along a space-filling curve; `to_internal` and `to_external` copy
/// shapes between the numberings.
struct PosingSystem {
  std::vector<std::int32_t> order;  ///< the caller's index of every internal vertex
  ElasticEnergy energy;
  std::vector<std::int32_t> pinned;  ///< vertices of the handles, internal
  std::vector<double> weights;       ///< stiffness * vertex mass, one per pinned vertex
  ScalarFactor factor;               ///< of (2 mu + lam) * Laplacian + 2 * weights on the diagonal

  PosingSystem(const LocalMesh& mesh, StVK material, std::vector<std::int32_t> pinned_vertices,
               std::vector<double> pin_weights)
      : order(mesh.order),
        energy{RestShape(mesh.vertices.data(), static_cast<int>(mesh.order.size()),
                         mesh.tets.data(), static_cast<int>(mesh.tets.size() / 4)),
               material},
        pinned(renumbered(std::move(pinned_vertices), mesh.places)),
        weights(std::move(pin_weights)),
        factor(scalar_matrix()) {}

  [[nodiscard]] int size() const { return 3 * energy.rest.vertex_count; }

  /// Energy of a strain of 1e-12 everywhere. Where the minimum of F is zero, no share of F is ever
  /// reached: a decrease below this is none.
  [[nodiscard]] double negligible() const {
    double volume = 0.0;
    for (const RestTet& tet : energy.rest.tets) volume += tet.volume;
    return 1e-24 * energy.material.mu * volume;
  }

  /// Copies a shape vector from the caller's numbering into the internal one.
  void to_internal(const double* from, double* to) const {
    for (std::size_t v = 0; v < order.size(); ++v) std::copy_n(from + 3 * order[v], 3, to + 3 * v);
  }
  /// And back.
  void to_external(const double* from, double* to) const {
    for (std::size_t v = 0; v < order.size(); ++v) std::copy_n(from + 3 * v, 3, to + 3 * order[v]);
  }

 private:
  static std::vector<std::int32_t> renumbered(std::vector<std::int32_t> vertices,
                                              const std::vector<std::int32_t>& places) {
    for (std::int32_t& vertex : vertices) vertex = places[vertex];
    return vertices;
  }

  [[nodiscard]] Eigen::SparseMatrix<double> scalar_matrix() const {
    Eigen::SparseMatrix<double> A =
        (2.0 * energy.material.mu + energy.material.lam) * energy.rest.laplacian();
    for (std::size_t k = 0; k < pinned.size(); ++k)
      A.coeffRef(pinned[k], pinned[k]) += 2.0 * weights[k];
    return A;
  }
};

/// The samples of one call: where each starts, what its handles ask for, where its shape goes.
struct PosingSamples {
  int count = 0;
  const double* targets = nullptr;  ///< count x pinned x 3, displacements
  const double* starts = nullptr;   ///< count x 3n, displacements
  double* shapes = nullptr;         ///< count x 3n, displacements; written as samples finish
};

/// The objective of the samples that are in the lanes now. Real is double (one lane) or Lanes.
///
/// This is all that a solver knows of a problem: size, negligible, load, value_and_gradient,
/// precondition.
template <class Real>
class PosingObjective {
 public:
  PosingObjective(const PosingSystem& system, const PosingSamples& samples)
      : system_(system), samples_(samples), targets_(3 * system.pinned.size(), Real(0.0)) {}

  [[nodiscard]] int size() const { return system_.size(); }

  [[nodiscard]] const double* target_of(int sample) const {
    return samples_.targets + static_cast<std::size_t>(sample) * targets_.size();
  }

  /// The lane's targets become those of `sample`.
  void load(int lane, int sample) {
    const double* target = target_of(sample);
    for (std::size_t k = 0; k < targets_.size(); ++k) set_lane(targets_[k], lane, target[k]);
  }

  [[nodiscard]] double negligible() const { return negligible_; }

  /// F at u (3n); its gradient overwrites `gradient`.
  Real value_and_gradient(const Real* u, Real* gradient) const {
    Real value = system_.energy.value_and_gradient(u, gradient);
    for (std::size_t k = 0; k < system_.pinned.size(); ++k) {
      const std::size_t at = 3 * static_cast<std::size_t>(system_.pinned[k]);
      const Real weight(system_.weights[k]);
      for (int c = 0; c < 3; ++c) {
        const Real offset = u[at + c] - targets_[3 * k + c];
        const Real force = weight * offset;
        value += force * offset;
        gradient[at + c] += force + force;
      }
    }
    return value;
  }

  /// result = A^{-1} vector with the scalar matrix A of the system; both 3n and of any precision,
  /// and they may be the same array. `scratch` is 3n.
  template <class Any>
  void precondition(const Any* vector, Any* result, Any* scratch) const {
    system_.factor.solve(vector, result, scratch);
  }

 private:
  static void set_lane(double& x, int, double value) { x = value; }
  template <class L>
  static void set_lane(L& x, int lane, double value) {
    x.set(lane, value);
  }

  const PosingSystem& system_;
  const PosingSamples& samples_;
  std::vector<Real> targets_;
  double negligible_ = system_.negligible();
};

}  // namespace snapspace
