#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

#include "energy/block_hessian.h"
#include "energy/elastic_energy.h"
#include "simd/lanes.h"
#include "snapshots/numbering.h"
#include "snapshots/pair_products.h"
#include "snapshots/scalar_inverse.h"

namespace snapspace {

template <class Real>
class PosingObjective;

/// What all samples of a posing problem share: F(u) = E(u) + sum_k weight_k |u_k - target_k|^2 over
/// pinned vertices k. Only the targets differ from sample to sample, so one inverse serves them
/// all.
struct PosingSystem {
  template <class Real>
  using Objective = PosingObjective<Real>;

  /// Handles hold the shape, and its solve is short. The material stiffens along every direction at
  /// first, which the scale of the seed knows at once: on 48 samples of the Dragon it is 48
  /// evaluations, 57 with two pairs and a fixed seed, 50 with two and a scaled one.
  static constexpr LbfgsMemory kMemory{.pairs = 1, .scaled = true};

  Numbering numbering;
  ElasticEnergy energy;
  std::vector<std::int32_t> pinned;  ///< vertices of the handles, internal
  std::vector<double> weights;       ///< stiffness * vertex mass, one per pinned vertex
  std::vector<std::int32_t> pins;    ///< of which pinned[k], weights[k]: by their vertices
  ScalarInverse inverse;             ///< of (2 mu + lam) * Laplacian + 2 * weights on the diagonal

  PosingSystem(const LocalMesh& mesh, StVK material, std::vector<std::int32_t> pinned_vertices,
               std::vector<double> pin_weights, InverseKind kind = InverseKind::automatic)
      : numbering(mesh.order),
        energy{RestShape(mesh.vertices.data(), static_cast<int>(mesh.order.size()),
                         mesh.tets.data(), static_cast<int>(mesh.tets.size() / 4)),
               material},
        pinned(renumbered(std::move(pinned_vertices), mesh.places)),
        weights(std::move(pin_weights)),
        pins(pinned.size()),
        inverse(scalar_matrix(), kind) {
    std::iota(pins.begin(), pins.end(), 0);
    std::sort(pins.begin(), pins.end(),
              [&](std::int32_t a, std::int32_t b) { return pinned[a] < pinned[b]; });
  }

  [[nodiscard]] int size() const { return 3 * energy.rest.vertex_count; }
  /// Of the displacements that one sample asks of the pinned vertices.
  [[nodiscard]] int input_size() const { return 3 * static_cast<int>(pinned.size()); }
  [[nodiscard]] double negligible() const { return energy.negligible(); }
  /// Weights of the vertices where lengths of displacements are compared.
  [[nodiscard]] std::vector<float> masses() const { return energy.rest.lumped_shares(); }
  [[nodiscard]] int inverted_tets(const double* u) const { return energy.inverted_tets(u); }

  /// Hessian of F at rest times v: elastic forces of small displacements, and the handles'.
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

/// The objective of the samples that are in the lanes now. Real is double (one lane) or a pack of
/// either precision.
///
/// This is all that a solver knows of a problem: size, negligible, load, value_and_gradient,
/// precondition, and for Newton's method hessian_pattern and assemble.
template <class Real>
class PosingObjective {
 public:
  explicit PosingObjective(const PosingSystem& system, int /*threads*/ = 1)
      : system_(system), targets_(system.input_size(), Real(0.0)) {}

  [[nodiscard]] int size() const { return system_.size(); }
  [[nodiscard]] double negligible() const { return negligible_; }

  /// The lane's targets become those of a sample (input_size() numbers).
  void load(int lane, const double* target) {
    for (std::size_t k = 0; k < targets_.size(); ++k) set_lane(targets_[k], lane, target[k]);
  }

  /// F at u (3n); its gradient overwrites `gradient`, and the visitor sees it whole.
  template <class Visitor = NoVisitor>
  Sum<Real> value_and_gradient(const Real* u, Real* gradient, Visitor&& visitor = {}) const {
    Pinning<std::remove_reference_t<Visitor>> pinning{*this, visitor, u, gradient};
    const Sum<Real> elastic = system_.energy.value_and_gradient(u, gradient, pinning);
    return elastic + pinning.value;
  }

  /// result = A^{-1} vector, or nearly, with the scalar matrix A of the system; both 3n and of any
  /// precision, and they may be the same array. Returns vector . result.
  template <class Any>
  Sum<Any> precondition(const Any* vector, Any* result) {
    return system_.inverse.apply(vector, result, scratch_);
  }

  [[nodiscard]] BlockHessian hessian_pattern() const { return BlockHessian(system_.energy.rest); }

  /// One lane only: the Hessian at u, clamped as BlockHessian::add does it.
  void assemble(const double* u, double clamp, BlockHessian& hessian) const {
    hessian.clear();
    hessian.add(system_.energy, u, clamp);
    for (std::size_t k = 0; k < system_.pinned.size(); ++k)
      hessian.add_to_diagonal(system_.pinned[k], 2.0 * system_.weights[k]);
  }

 private:
  /// Adds the handles' part to vertices that are complete.
  template <class Visitor>
  struct Pinning {
    const PosingObjective& objective;
    Visitor& visitor;
    const Real* u;
    Real* gradient;
    Sum<Real> value{0.0};
    std::size_t next = 0;  // of the pins

    void before(int begin, int end) { visitor.before(begin, end); }
    void after(int begin, int end) {
      const PosingSystem& system = objective.system_;
      for (; next < system.pins.size() && system.pinned[system.pins[next]] < end; ++next)
        add(system.pins[next]);
      visitor.after(begin, end);
    }
    void add(std::size_t k) {
      const std::size_t at = 3 * static_cast<std::size_t>(objective.system_.pinned[k]);
      const Real weight(objective.system_.weights[k]);
      for (int c = 0; c < 3; ++c) {
        const Real offset = u[at + c] - objective.targets_[3 * k + c];
        const Real force = weight * offset;
        value += widened(force * offset);
        gradient[at + c] += force + force;
      }
    }
  };

  const PosingSystem& system_;
  std::vector<Real> targets_;
  double negligible_ = system_.negligible();
  Scratch scratch_;
};

}  // namespace snapspace
