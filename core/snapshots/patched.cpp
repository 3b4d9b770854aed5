#include "snapshots/patched.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "memory/streamed_vector.h"
#include "patches/patch_hessian.h"
#include "snapshots/sample_seed.h"

namespace snapspace {

namespace {

constexpr int kMotions = RigidPatches::kMotions;

template <class Real>
class PatchedObjective final : public LaneObjective<Real> {
 public:
  using Single = typename LaneObjective<Real>::Single;

  PatchedObjective(const SampleSystem& system, std::unique_ptr<LaneObjective<Real>> objective)
      : system_(system),
        patches_(*system.patches()),
        objective_(std::move(objective)),
        positions_(system.size(), Single(0)),
        sums_(patches_.dimension()),
        motions_(sums_.size()),
        one_(sums_.size()),
        forces_(sums_.size()) {}

  [[nodiscard]] int size() const override { return objective_->size(); }
  [[nodiscard]] double negligible() const override { return objective_->negligible(); }
  void load(int lane, const double* input) override { objective_->load(lane, input); }

  [[nodiscard]] std::shared_ptr<const SampleSeed> seed_near(const double* input,
                                                            const double* u) const override {
    PatchHessian hessian(patches_, u);
    system_.add_to(hessian, input, u);
    std::optional<online::DenseCholesky> factor = hessian.factor();
    if (!factor) return nullptr;
    const std::vector<double>& positions = hessian.positions();
    return std::make_shared<const SampleSeed>(
        SampleSeed{{positions.begin(), positions.end()}, hessian.centers(), std::move(*factor)});
  }

  void load_seed(int lane, std::shared_ptr<const SampleSeed> seed) override {
    for (std::size_t i = 0; seed && i < positions_.size(); ++i)
      set_lane(positions_[i], lane, seed->positions[i]);
    seeds_[lane] = std::move(seed);
  }

  Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) override {
    return objective_->value_and_gradient(u, gradient, visitor);
  }

  Sum<Single> precondition(const Single* vector, Single* result) override {
    find_sums(vector);  // before the vector is overwritten
    Sum<Single> product = solve();
    product += objective_->precondition(vector, result);
    add_motions(result);
    return product;
  }

 private:
  [[nodiscard]] static Single narrowed(const Sum<Single>& a) {
    return cast<typename Single::Scalar>(a);
  }

  /// Forces and torques about the mean that a vector exerts on the patches.
  void find_sums(const Single* vector) {
    std::fill(sums_.begin(), sums_.end(), Sum<Single>(0.0));
    for (int i = 0; i < patches_.vertices(); ++i) {
      const Single* const f = vector + 3 * static_cast<std::size_t>(i);
      const Single* const x = &positions_[3 * static_cast<std::size_t>(i)];
      Single wrench[kMotions] = {f[0], f[1], f[2]};
      wrench[3] = x[1] * f[2] - x[2] * f[1];
      wrench[4] = x[2] * f[0] - x[0] * f[2];
      wrench[5] = x[0] * f[1] - x[1] * f[0];
      for (const auto* place = patches_.begin(i); place != patches_.end(i); ++place) {
        Sum<Single>* const sum = &sums_[kMotions * static_cast<std::size_t>(place->patch)];
        for (int k = 0; k < kMotions; ++k) sum[k] += widened(Single(place->hat) * wrench[k]);
      }
    }
  }

  /// Motions of the patches that these forces cause, about the mean; returns their product.
  Sum<Single> solve() {
    Sum<Single> product(0.0);
    std::fill(motions_.begin(), motions_.end(), Sum<Single>(0.0));
    for (int lane = 0; lane < Real::kWidth; ++lane) {
      const SampleSeed* const seed = seeds_[lane].get();
      if (!seed) continue;
      const double* center = seed->centers.data();
      for (std::size_t i = 0; i < one_.size(); ++i) one_[i] = sums_[i][lane];
      for (std::size_t a = 0; a < one_.size(); a += kMotions)
        add_cross(-1.0, center + a / 2, &one_[a], &one_[a + 3]);
      forces_ = one_;
      seed->factor.solve(one_.data(), one_.data());
      double sum = 0.0;
      for (std::size_t i = 0; i < one_.size(); ++i) sum += forces_[i] * one_[i];
      product.set(lane, sum);
      for (std::size_t a = 0; a < one_.size(); a += kMotions)
        add_cross(1.0, center + a / 2, &one_[a + 3], &one_[a]);
      for (std::size_t i = 0; i < one_.size(); ++i) motions_[i].set(lane, one_[i]);
    }
    return product;
  }

  /// to += sign * center x from
  static void add_cross(double sign, const double* c, const double* from, double* to) {
    to[0] += sign * (c[1] * from[2] - c[2] * from[1]);
    to[1] += sign * (c[2] * from[0] - c[0] * from[2]);
    to[2] += sign * (c[0] * from[1] - c[1] * from[0]);
  }

  void add_motions(Single* result) const {
    for (int i = 0; i < patches_.vertices(); ++i) {
      Sum<Single> sum[kMotions];
      std::fill_n(sum, kMotions, Sum<Single>(0.0));
      for (const auto* place = patches_.begin(i); place != patches_.end(i); ++place) {
        const Sum<Single>* const motion =
            &motions_[kMotions * static_cast<std::size_t>(place->patch)];
        for (int k = 0; k < kMotions; ++k)
          sum[k] += Sum<Single>(static_cast<double>(place->hat)) * motion[k];
      }
      Single t[3], w[3];
      for (int r = 0; r < 3; ++r) t[r] = narrowed(sum[r]), w[r] = narrowed(sum[3 + r]);
      const Single* const x = &positions_[3 * static_cast<std::size_t>(i)];
      Single* const to = result + 3 * static_cast<std::size_t>(i);
      to[0] += t[0] + (w[1] * x[2] - w[2] * x[1]);
      to[1] += t[1] + (w[2] * x[0] - w[0] * x[2]);
      to[2] += t[2] + (w[0] * x[1] - w[1] * x[0]);
    }
  }

  const SampleSystem& system_;
  const RigidPatches& patches_;
  std::unique_ptr<LaneObjective<Real>> objective_;
  StreamedVector<Single> positions_;
  std::shared_ptr<const SampleSeed> seeds_[Real::kWidth];
  std::vector<Sum<Single>> sums_, motions_;  // V^T vector, and B times it
  std::vector<double> one_, forces_;         // those of a lane
};

}  // namespace

LaneObjectives on_patches(const SampleSystem& system) {
  LaneObjectives objectives = system.lanes();
  std::vector<float> masses = objectives.masses();
  return {std::move(masses),
          [objectives = std::move(objectives), &system]<class Real>(const ThreadShare& threads) {
            return std::make_unique<PatchedObjective<Real>>(system,
                                                            objectives.objective<Real>(threads));
          }};
}

}  // namespace snapspace
