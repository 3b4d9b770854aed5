#include "snapshots/two_level.h"

#include <memory>
#include <utility>
#include <vector>

namespace snapspace {

namespace {

template <class Real>
class TwoLevelObjective final : public LaneObjective<Real> {
 public:
  using Single = typename LaneObjective<Real>::Single;

  TwoLevelObjective(std::unique_ptr<LaneObjective<Real>> objective, int input_size,
                    const CoarseSpace& coarse)
      : objective_(std::move(objective)),
        input_size_(input_size),
        coarse_(coarse),
        along_(coarse.blocks().size()),
        solved_(along_.size()),
        inverse_(static_cast<std::size_t>(coarse.dimension()) * coarse.dimension(), Single(0)) {}

  [[nodiscard]] int size() const override { return objective_->size(); }
  [[nodiscard]] double negligible() const override { return objective_->negligible(); }

  void load(int lane, const double* input) override {
    objective_->load(lane, input);
    for (std::size_t e = 0; e < inverse_.size(); ++e)
      set_lane(inverse_[e], lane, input[input_size_ + e]);
  }

  Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) override {
    return objective_->value_and_gradient(u, gradient, visitor);
  }

  Sum<Single> precondition(const Single* vector, Single* result) override {
    const std::vector<EightModes>& blocks = coarse_.blocks();
    for (std::size_t b = 0; b < blocks.size(); ++b) along_[b] = blocks[b].products(vector);
    Sum<Single> product = solve();  // before the vector is overwritten
    product += objective_->precondition(vector, result);
    for (std::size_t b = 0; b < blocks.size(); ++b) blocks[b].add(solved_[b], result);
    return product;
  }

 private:
  static constexpr int kCount = EightModes::kCount;

  /// solved = B along; returns their product.
  Sum<Single> solve() {
    const int d = coarse_.dimension();
    Sum<Single> product(0.0);
    for (auto& block : solved_) block.fill(Sum<Single>(0.0));
    for (int i = 0; i < d; ++i) {
      const Single* row = &inverse_[static_cast<std::size_t>(i) * d];
      Sum<Single> sum(0.0);
      for (int j = 0; j < d; ++j) sum += widened(row[j]) * along_[j / kCount][j % kCount];
      solved_[i / kCount][i % kCount] = sum;
      product += sum * along_[i / kCount][i % kCount];
    }
    return product;
  }

  std::unique_ptr<LaneObjective<Real>> objective_;
  int input_size_;
  const CoarseSpace& coarse_;
  std::vector<EightModes::Coordinates<Single>> along_, solved_;  // V^T vector, and B times it
  StreamedVector<Single> inverse_;                               // B
};

}  // namespace

LaneObjectives on_two_levels(LaneObjectives objectives, int input_size, const CoarseSpace& coarse) {
  std::vector<float> masses = objectives.masses();
  return {std::move(masses), [objectives = std::move(objectives), input_size,
                              &coarse]<class Real>(const ThreadShare& threads) {
            return std::make_unique<TwoLevelObjective<Real>>(objectives.objective<Real>(threads),
                                                             input_size, coarse);
          }};
}

}  // namespace snapspace
