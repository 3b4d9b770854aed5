#include "polish/two_level.h"

#include <memory>
#include <utility>

namespace snapspace {

namespace {

template <class Real>
class TwoLevelObjective final : public LaneObjective<Real> {
 public:
  using Single = typename LaneObjective<Real>::Single;

  TwoLevelObjective(std::unique_ptr<LaneObjective<Real>> objective, const CoarseSpace& coarse,
                    const Eigen::MatrixXf& inverse, LowestShape& lowest)
      : objective_(std::move(objective)),
        coarse_(coarse),
        inverse_(inverse),
        lowest_(lowest),
        vector_(objective_->size()),
        correction_(objective_->size()) {}

  [[nodiscard]] int size() const override { return objective_->size(); }
  [[nodiscard]] double negligible() const override { return objective_->negligible(); }
  void load(int lane, const double* input) override { objective_->load(lane, input); }

  Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) override {
    const Sum<Real> value = objective_->value_and_gradient(u, gradient, visitor);
    ++lowest_.evaluations;
    if (value[0] < lowest_.value) {
      lowest_.value = value[0];
      lowest_.shape.resize(static_cast<std::size_t>(size()));
      for (int i = 0; i < size(); ++i) lowest_.shape[i] = u[i][0];
    }
    return value;
  }

  /// The other lanes are unused.
  Sum<Single> precondition(const Single* vector, Single* result) override {
    for (int i = 0; i < size(); ++i) vector_[i] = vector[i][0];
    const double along = coarse_.solve(inverse_, vector_, correction_);
    Sum<Single> product = objective_->precondition(vector, result);
    for (int i = 0; i < size(); ++i) result[i].set(0, result[i][0] + correction_[i]);
    product.set(0, product[0] + along);
    return product;
  }

 private:
  std::unique_ptr<LaneObjective<Real>> objective_;
  const CoarseSpace& coarse_;
  const Eigen::MatrixXf& inverse_;  // B
  LowestShape& lowest_;
  Eigen::VectorXf vector_, correction_;
};

}  // namespace

LaneObjectives on_two_levels(LaneObjectives objectives, const CoarseSpace& coarse,
                             const Eigen::MatrixXf& inverse, LowestShape& lowest) {
  std::vector<float> masses = objectives.masses();
  return {std::move(masses), [objectives = std::move(objectives), &coarse, &inverse,
                              &lowest]<class Real>(int threads) {
            return std::make_unique<TwoLevelObjective<Real>>(objectives.objective<Real>(threads),
                                                             coarse, inverse, lowest);
          }};
}

}  // namespace snapspace
