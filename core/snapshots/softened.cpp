#include "snapshots/softened.h"

#include <memory>
#include <utility>

namespace snapspace {

namespace {

template <class Real>
class SoftenedObjective final : public LaneObjective<Real> {
 public:
  using Single = typename LaneObjective<Real>::Single;

  SoftenedObjective(std::unique_ptr<LaneObjective<Real>> objective, const SoftModes& modes)
      : objective_(std::move(objective)), modes_(modes) {}

  [[nodiscard]] int size() const override { return objective_->size(); }
  [[nodiscard]] double negligible() const override { return objective_->negligible(); }
  void load(int lane, const double* input) override { objective_->load(lane, input); }

  Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) override {
    return objective_->value_and_gradient(u, gradient, visitor);
  }

  Sum<Single> precondition(const Single* vector, Single* result) override {
    const auto correction = modes_.correction(vector);
    const Sum<Single> product = objective_->precondition(vector, result);
    modes_.add(correction, result);
    return product + correction.product;
  }

 private:
  std::unique_ptr<LaneObjective<Real>> objective_;
  const SoftModes& modes_;
};

}  // namespace

LaneObjectives softened(LaneObjectives objectives, const SoftModes& modes) {
  std::vector<float> masses = objectives.masses();
  return {std::move(masses),
          [objectives = std::move(objectives), &modes]<class Real>(const ThreadShare& threads) {
            return std::make_unique<SoftenedObjective<Real>>(objectives.objective<Real>(threads),
                                                             modes);
          }};
}

}  // namespace snapspace
