#include "snapshots/posing_system.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "snapshots/lane_objectives.h"

namespace snapspace {

namespace {

std::vector<std::int32_t> renumbered(std::vector<std::int32_t> vertices,
                                     const std::vector<std::int32_t>& places) {
  for (std::int32_t& vertex : vertices) vertex = places[vertex];
  return vertices;
}

Eigen::SparseMatrix<double> scalar_matrix(const ElasticEnergy& energy,
                                          const std::vector<std::int32_t>& pinned,
                                          const std::vector<double>& weights) {
  Eigen::SparseMatrix<double> A = energy.scalar_matrix();
  for (std::size_t k = 0; k < pinned.size(); ++k)
    A.coeffRef(pinned[k], pinned[k]) += 2.0 * weights[k];
  return A;
}

/// The objective of PosingSystem.
template <class Real>
class PosingObjective final : public LaneObjective<Real> {
 public:
  using Single = typename LaneObjective<Real>::Single;

  explicit PosingObjective(const PosingSystem& system)
      : system_(system), targets_(system.input_size(), Real(0.0)) {}

  [[nodiscard]] int size() const override { return system_.size(); }
  [[nodiscard]] double negligible() const override { return system_.energy.negligible(); }

  void load(int lane, const double* target) override {
    for (std::size_t k = 0; k < targets_.size(); ++k) set_lane(targets_[k], lane, target[k]);
  }

  Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) override {
    Pinning pinning(*this, visitor, u, gradient);
    const Sum<Real> elastic = system_.energy.value_and_gradient(u, gradient, pinning);
    return elastic + pinning.value;
  }

  Sum<Single> precondition(const Single* vector, Single* result) override {
    return system_.inverse.apply(vector, result, scratch_);
  }

 private:
  /// Adds the handles' part at vertices whose elastic part is complete.
  struct Pinning final : SweepVisitor {
    const PosingObjective& objective;
    SweepVisitor& visitor;
    const Real* u;
    Real* gradient;
    Sum<Real> value{0.0};
    std::size_t next = 0;  // among the pins

    Pinning(const PosingObjective& owner, SweepVisitor& inner, const Real* shape, Real* forces)
        : objective(owner), visitor(inner), u(shape), gradient(forces) {}

    void before(int begin, int end) override { visitor.before(begin, end); }
    void after(int begin, int end) override {
      const PosingSystem& system = objective.system_;
      for (; next < system.pins.size() && system.pinned[system.pins[next]] < end; ++next)
        add(system.pins[next]);
      visitor.after(begin, end);
    }
    void add(std::size_t k) {
      const std::size_t at = 3 * static_cast<std::size_t>(objective.system_.pinned[k]);
      const Real weight(static_cast<typename ScalarOf<Real>::type>(objective.system_.weights[k]));
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
  Scratch scratch_;
};

}  // namespace

PosingSystem::PosingSystem(const LocalMesh& mesh, const MaterialField& material,
                           const std::vector<std::int32_t>& pinned_vertices,
                           const std::vector<double>& pin_weights, InverseKind kind)
    : PosingSystem(
          mesh,
          ElasticEnergy(
              RestShape(mesh.vertices.data(), static_cast<int>(mesh.order.size()), mesh.tets.data(),
                        static_cast<int>(mesh.tets.size() / 4), is_of_shells(material.view().kind)),
              material.reordered(mesh.tet_order, mesh.order)),
          renumbered(pinned_vertices, mesh.places), pin_weights, kind) {}

PosingSystem::PosingSystem(const LocalMesh& mesh, ElasticEnergy elastic,
                           const std::vector<std::int32_t>& internal,
                           const std::vector<double>& pin_weights, InverseKind kind)
    : SampleSystem(Numbering(mesh.order),
                   ScalarInverse(scalar_matrix(elastic, internal, pin_weights), kind)),
      energy(std::move(elastic)),
      pinned(internal),
      weights(pin_weights),
      pins(pinned.size()) {
  std::iota(pins.begin(), pins.end(), 0);
  std::sort(pins.begin(), pins.end(),
            [&](std::int32_t a, std::int32_t b) { return pinned[a] < pinned[b]; });
}

LaneObjectives PosingSystem::lanes() const {
  return {energy.rest.lumped_shares(), [this]<class Real>(const ThreadShare&) {
            return std::make_unique<PosingObjective<Real>>(*this);
          }};
}

std::unique_ptr<LaneObjective<double>> PosingSystem::objective() const {
  return std::make_unique<PosingObjective<double>>(*this);
}

void PosingSystem::assemble(const double* /*input*/, const double* u, const HessianOptions& options,
                            BlockHessian& hessian) const {
  hessian.clear();
  hessian.add(energy, u, options.projection, options.threshold);
  for (std::size_t k = 0; k < pinned.size(); ++k)
    hessian.add_to_diagonal(pinned[k], 2.0 * weights[k]);
}

}  // namespace snapspace
