#include "snapshots/evaluate.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "snapshots/lane_objectives.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

constexpr int kWidth = kWideLanes;
using Wide = Lanes<kWidth>;

/// Evaluates one pack of displacements after the other.
class Evaluation {
 public:
  explicit Evaluation(const SampleSystem& system, const LaneObjectives& objectives)
      : system_(system),
        objective_(objectives.objective<Wide>(1)),
        shapes_(system.size(), Wide(0.0)),
        gradients_(system.size(), Wide(0.0)),
        one_(system.size()) {}

  /// The same as `evaluate`, for at most one pack.
  void operator()(int count, const double* inputs, const double* shapes, double* values,
                  double* gradients) {
    const int size = system_.size();
    for (int lane = 0; lane < kWidth; ++lane) {
      const int sample = std::min(lane, count - 1);  // unused lanes repeat the last sample
      objective_->load(lane, inputs + sample * system_.input_size());
      system_.numbering.to_internal(shapes + static_cast<std::size_t>(sample) * size, one_.data());
      for (int i = 0; i < size; ++i) shapes_[i].set(lane, one_[i]);
    }
    SweepVisitor idle;
    const auto sums = objective_->value_and_gradient(shapes_.data(), gradients_.data(), idle);
    for (int lane = 0; lane < count; ++lane) {
      values[lane] = sums[lane];
      for (int i = 0; i < size; ++i) one_[i] = gradients_[i][lane];
      system_.numbering.to_external(one_.data(), gradients + static_cast<std::size_t>(lane) * size);
    }
  }

 private:
  const SampleSystem& system_;
  std::unique_ptr<LaneObjective<Wide>> objective_;
  std::vector<Wide> shapes_, gradients_;
  std::vector<double> one_;
};

}  // namespace

void evaluate(const SampleSystem& system, int count, const double* inputs, const double* shapes,
              double* values, double* gradients, int threads) {
  const LaneObjectives objectives = system.lanes();
  const int packs = (count + kWidth - 1) / kWidth, size = system.size();
  const int workers = std::clamp(
      threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency()), 1, packs);
  std::atomic<int> next{0};
  parallel_for(workers, workers, [&](int) {
    const FlushDenormals flush;
    Evaluation evaluation(system, objectives);
    for (int pack = next++; pack < packs; pack = next++) {
      const int first = pack * kWidth;
      evaluation(std::min(kWidth, count - first), inputs + first * system.input_size(),
                 shapes + static_cast<std::size_t>(first) * size, values + first,
                 gradients + static_cast<std::size_t>(first) * size);
    }
  });
}

}  // namespace snapspace
