#include "snapshots/interpolation_system.h"

#include <utility>

#include "energy/scalar_hessian.h"
#include "patches/patch_hessian.h"
#include "snapshots/lane_objectives.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Maximum number of patches of a surface. With 30, 60 and 100, a sample of the Centaur takes 34,
/// 29 and 27 evaluations.
constexpr int kMostPatches = 64;
/// Maximum number of patches of a solid. With 64, blends take as many evaluations, and seeds take
/// longer.
constexpr int kMostPatchesOfSolids = 32;
/// Solids with fewer tets have no patches. A seed takes 2 ms for any number of tets; with 8,000
/// tets, a blend takes 23 ms with patches and 17 ms without.
constexpr std::size_t kFewTets = 20'000;

/// Edges between the corners of each triangle or tet, with their mean lengths in the poses.
EdgeGraph edges_of(const RestShape& rest, const std::vector<double>& poses, int count,
                   int corners) {
  std::vector<std::int32_t> cells;
  cells.reserve(corners * rest.tets.size());
  for (const RestTet& tet : rest.tets)
    cells.insert(cells.end(), tet.vertices, tet.vertices + corners);
  return {poses.data(), count, rest.vertex_count, cells.data(), static_cast<int>(rest.tets.size()),
          corners};
}

/// The matrix of a shell: the mean of the matrices at rest in the poses, each at its mean weight.
Eigen::SparseMatrix<double> shell_matrix(const BlendedEnergy& energy,
                                         const std::vector<double>& weights) {
  const int poses = energy.poses();
  const auto samples = static_cast<double>(weights.size() / poses);
  Eigen::SparseMatrix<double> A;
  for (int k = 0; k < poses; ++k) {
    double weight = 0.0;
    for (std::size_t i = k; i < weights.size(); i += poses) weight += weights[i] / samples;
    const Eigen::SparseMatrix<double> pose = weight * energy.energy(k).scalar_matrix();
    A = k == 0 ? pose : Eigen::SparseMatrix<double>(A + pose);
  }
  return A;
}

/// Adds `factor` times the Hessian at a shape u for its weights.
void add_shape(const BlendedEnergy& energy, const double* u, const double* weights, double factor,
               ScalarHessian& hessian) {
  if (energy.has_scalar_hessians()) return hessian.add(energy, weights, u, factor);
  std::vector<double> shifted(energy.size());
  for (int k = 0; k < energy.poses(); ++k) {
    if (weights[k] == 0.0) continue;
    for (int i = 0; i < energy.size(); ++i) shifted[i] = u[i] + energy.offset(k)[i];
    hessian.add(energy.energy(k), shifted.data(), factor * weights[k]);
  }
}

Eigen::SparseMatrix<double> scalar_matrix(const BlendedEnergy& energy,
                                          const std::vector<double>& shapes,
                                          const std::vector<double>& weights) {
  if (energy.energy(0).rest.shell) {
    Eigen::SparseMatrix<double> A = shell_matrix(energy, weights);
    A.coeffRef(0, 0) *= 2.0;
    return A;
  }
  ScalarHessian hessian(energy.energy(0).rest);
  const std::size_t size = energy.size(), poses = energy.poses(), count = shapes.size() / size;
  for (std::size_t shape = 0; shape < count; ++shape)
    add_shape(energy, &shapes[shape * size], &weights[shape * poses], 1.0 / count, hessian);
  Eigen::SparseMatrix<double> A = hessian.matrix();
  A.coeffRef(0, 0) *= 2.0;
  return A;
}

/// The objective of InterpolationSystem.
template <class Real>
class InterpolationObjective final : public LaneObjective<Real> {
 public:
  using Single = typename LaneObjective<Real>::Single;

  /// @param threads  those that the objective may use, now and later
  InterpolationObjective(const InterpolationSystem& system, const ThreadShare& threads)
      : system_(system),
        threads_(threads),
        blend_(system.energy->blend_size(), Real(0.0)),
        second_half_(system.size(), Real(0.0)) {}

  [[nodiscard]] int size() const override { return system_.size(); }
  [[nodiscard]] double negligible() const override {
    return system_.energy->energy(0).negligible();
  }

  void load(int lane, const double* weights) override {
    system_.energy->set_weights(lane, weights, blend_.data());
  }

  /// A few samples fill only a pack or two, which would leave threads idle. So the tets are visited
  /// in two halves, for any number of threads and any width of the pack: other parts would round
  /// differently.
  Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) override {
    visitor.before(0, size() / 3);
    const int tets = system_.energy->tets();
    Sum<Real> values[2];
    parallel_for(2, threads_.each(), [&](int half) {
      const FlushDenormals flush;  // as on the caller's thread
      values[half] = system_.energy->value_and_gradient(
          blend_.data(), u, half == 0 ? gradient : second_half_.data(), half == 0 ? 0 : tets / 2,
          half == 0 ? tets / 2 : tets);
    });
    for (int i = 0; i < size(); ++i) gradient[i] += second_half_[i];
    visitor.after(0, size() / 3);
    return values[0] + values[1];
  }

  Sum<Single> precondition(const Single* vector, Single* result) override {
    return system_.inverse.apply(vector, result, scratch_);
  }

 private:
  const InterpolationSystem& system_;
  const ThreadShare& threads_;
  std::vector<Real> blend_;
  std::vector<Real> second_half_;  // second half of the gradient
  Scratch scratch_;
};

}  // namespace

InterpolationSystem::InterpolationSystem(const LocalMesh& mesh, const std::vector<double>& poses,
                                         int count, const MaterialField& material)
    : InterpolationSystem(
          Numbering(mesh.order),
          std::make_shared<BlendedEnergy>(poses.data(), count, static_cast<int>(mesh.order.size()),
                                          mesh.tets.data(), static_cast<int>(mesh.tets.size() / 4),
                                          material.reordered(mesh.tet_order, mesh.order)),
          mesh.tet_order, poses) {}

InterpolationSystem::InterpolationSystem(Numbering numbers,
                                         std::shared_ptr<const BlendedEnergy> blended,
                                         std::vector<std::int32_t> tets,
                                         const std::vector<double>& poses)
    : InterpolationSystem(std::move(numbers), blended, std::move(tets), seed_of(*blended, poses)) {}

InterpolationSystem::InterpolationSystem(Numbering numbers,
                                         std::shared_ptr<const BlendedEnergy> blended,
                                         std::vector<std::int32_t> tets, Seed seed)
    : SampleSystem(std::move(numbers), std::move(*seed.scalar)),
      energy(std::move(blended)),
      tet_order(std::move(tets)),
      patches_(std::move(seed.patches)) {}

InterpolationSystem::Seed InterpolationSystem::seed_of(const BlendedEnergy& energy,
                                                       const std::vector<double>& poses) {
  Seed seed;
  parallel_for(2, 0, [&](int part) {  // each is serial and takes about as long
    if (part == 0)
      seed.patches = patches_of(energy, poses);
    else
      seed.scalar.emplace(scalar_matrix(energy, std::vector<double>(energy.size(), 0.0),
                                        std::vector<double>(energy.poses(), 1.0 / energy.poses())));
  });
  return seed;
}

InterpolationSystem::Patches InterpolationSystem::patches_of(const BlendedEnergy& energy,
                                                             const std::vector<double>& poses) {
  const RestShape& rest = energy.energy(0).rest;
  const bool of_stars = energy.energy(0).stars.has_value();
  if (!of_stars && (!energy.has_tet_hessians() || rest.tets.size() < kFewTets)) return {};
  const auto rigid = std::make_shared<RigidPatches>(
      poses.data(), edges_of(rest, poses, energy.poses(), of_stars ? 3 : 4),
      of_stars ? kMostPatches : kMostPatchesOfSolids);
  if (rigid->count() == 0) return {};
  return {rigid, of_stars ? nullptr : std::make_shared<TetSample>(*rigid, rest)};
}

InterpolationSystem InterpolationSystem::adapted(const std::vector<double>& shapes,
                                                 const std::vector<double>& weights) const {
  return {numbering, energy, tet_order,
          Seed{patches_, inverse.of(scalar_matrix(*energy, shapes, weights))}};
}

void InterpolationSystem::add_to(PatchHessian& hessian, const double* weights,
                                 const double* u) const {
  if (patches_.tets) return hessian.add(*energy, *patches_.tets, weights, u);
  std::vector<PatchHessian::Part> parts;
  for (int k = 0; k < energy->poses(); ++k)
    if (weights[k] != 0.0) parts.push_back({&*energy->energy(k).stars, weights[k]});
  hessian.add(parts);
}

LaneObjectives InterpolationSystem::lanes() const {
  return {energy->energy(0).rest.lumped_shares(), [this]<class Real>(const ThreadShare& threads) {
            return std::make_unique<InterpolationObjective<Real>>(*this, threads);
          }};
}

std::unique_ptr<LaneObjective<double>> InterpolationSystem::objective() const {
  return std::make_unique<InterpolationObjective<double>>(*this, kOneThread);
}

void InterpolationSystem::assemble(const double* weights, const double* u,
                                   const HessianOptions& options, BlockHessian& hessian) const {
  hessian.clear();
  std::vector<double> shifted(size());
  for (int k = 0; k < energy->poses(); ++k) {
    const std::vector<double>& offset = energy->offset(k);
    for (int i = 0; i < size(); ++i) shifted[i] = u[i] + offset[i];
    hessian.add(energy->energy(k), shifted.data(), options.projection, options.threshold,
                weights[k]);
  }
}

}  // namespace snapspace
