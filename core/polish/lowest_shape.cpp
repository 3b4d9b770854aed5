#include "polish/lowest_shape.h"

#include <memory>
#include <utility>

namespace snapspace {

namespace {

template <class Real>
class WatchedObjective final : public LaneObjective<Real> {
 public:
  using Single = typename LaneObjective<Real>::Single;

  WatchedObjective(std::unique_ptr<LaneObjective<Real>> objective, LowestShape& lowest)
      : objective_(std::move(objective)), lowest_(lowest) {}

  [[nodiscard]] int size() const override { return objective_->size(); }
  [[nodiscard]] double negligible() const override { return objective_->negligible(); }
  void load(int lane, const double* input) override { objective_->load(lane, input); }
  [[nodiscard]] std::shared_ptr<const SampleSeed> seed_near(const double* input,
                                                            const double* u) const override {
    return objective_->seed_near(input, u);
  }
  void load_seed(int lane, std::shared_ptr<const SampleSeed> seed) override {
    objective_->load_seed(lane, std::move(seed));
  }

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

  Sum<Single> precondition(const Single* vector, Single* result) override {
    return objective_->precondition(vector, result);
  }

 private:
  std::unique_ptr<LaneObjective<Real>> objective_;
  LowestShape& lowest_;
};

}  // namespace

LaneObjectives watched(LaneObjectives objectives, LowestShape& lowest) {
  std::vector<float> masses = objectives.masses();
  return {std::move(masses),
          [objectives = std::move(objectives), &lowest]<class Real>(const ThreadShare& threads) {
            return std::make_unique<WatchedObjective<Real>>(objectives.objective<Real>(threads),
                                                            lowest);
          }};
}

}  // namespace snapspace
