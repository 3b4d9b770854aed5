#include "snapshots/patched.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "memory/streamed_vector.h"

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
        centers_(3 * static_cast<std::size_t>(patches_.count()), Sum<Single>(0.0)),
        inverse_(static_cast<std::size_t>(patches_.dimension()) * patches_.dimension(), Single(0)),
        sums_(patches_.dimension()),
        motions_(sums_.size()) {}

  [[nodiscard]] int size() const override { return objective_->size(); }
  [[nodiscard]] double negligible() const override { return objective_->negligible(); }
  void load(int lane, const double* input) override { objective_->load(lane, input); }

  [[nodiscard]] std::shared_ptr<const SampleSeed> seed_near(const double* input,
                                                            const double* u) const override {
    PatchHessian hessian(patches_, u);
    system_.add_to(hessian, input);
    const Eigen::MatrixXd inverse = hessian.inverse();
    SampleSeed seed;
    seed.positions.assign(hessian.positions().begin(), hessian.positions().end());
    seed.centers = hessian.centers();
    seed.inverse.assign(inverse.data(), inverse.data() + inverse.size());
    return std::make_shared<const SampleSeed>(std::move(seed));
  }

  void load_seed(int lane, const SampleSeed& seed) override {
    for (std::size_t i = 0; i < positions_.size(); ++i)
      set_lane(positions_[i], lane, seed.positions[i]);
    for (std::size_t i = 0; i < centers_.size(); ++i) set_lane(centers_[i], lane, seed.centers[i]);
    for (std::size_t i = 0; i < inverse_.size(); ++i) set_lane(inverse_[i], lane, seed.inverse[i]);
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
    const auto d = static_cast<std::size_t>(patches_.dimension());
    for (std::size_t a = 0; a < d; a += kMotions) turn_about(&centers_[a / 2], &sums_[a], 3, 0, -1);
    Sum<Single> product(0.0);
    for (std::size_t i = 0; i < d; ++i) {
      const Single* const row = &inverse_[i * d];
      Sum<Single> sum(0.0);
      for (std::size_t j = 0; j < d; ++j) sum += widened(row[j]) * sums_[j];
      motions_[i] = sum;
      product += sum * sums_[i];
    }
    for (std::size_t a = 0; a < d; a += kMotions)
      turn_about(&centers_[a / 2], &motions_[a], 0, 3, 1);
    return product;
  }

  /// Adds sign * center x (three entries from `from`) to those from `to`.
  static void turn_about(const Sum<Single>* c, Sum<Single>* entries, int to, int from, int sign) {
    const Sum<Single> factor(static_cast<double>(sign));
    const Sum<Single>* f = entries + from;
    const Sum<Single> turned[3] = {c[1] * f[2] - c[2] * f[1], c[2] * f[0] - c[0] * f[2],
                                   c[0] * f[1] - c[1] * f[0]};
    for (int r = 0; r < 3; ++r) entries[to + r] += factor * turned[r];
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
  std::vector<Sum<Single>> centers_;
  StreamedVector<Single> inverse_;           // B
  std::vector<Sum<Single>> sums_, motions_;  // V^T vector, and B times it
};

}  // namespace

LaneObjectives on_patches(const SampleSystem& system) {
  LaneObjectives objectives = system.lanes();
  std::vector<float> masses = objectives.masses();
  return {std::move(masses),
          [objectives = std::move(objectives), &system]<class Real>(int threads) {
            return std::make_unique<PatchedObjective<Real>>(system,
                                                            objectives.objective<Real>(threads));
          }};
}

}  // namespace snapspace
