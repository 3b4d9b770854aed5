#include "snapshots/evaluate.h"

#include <algorithm>
#include <atomic>
#include <type_traits>
#include <vector>

#include "snapshots/lane_objectives.h"
#include "snapshots/lane_seed.h"
#include "snapshots/solve.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Evaluates one pack of displacements after the other.
template <class Real>
class Evaluation {
 public:
  static constexpr int kWidth = Real::kWidth;

  explicit Evaluation(const SampleSystem& system, const LaneObjectives& objectives)
      : system_(system),
        objective_(objectives.objective<Real>(kOneThread)),
        shapes_(system.size(), Real(0)),
        gradients_(system.size(), Real(0)),
        one_(system.size()) {}

  /// The same as `evaluate`, for at most one pack.
  void operator()(int count, const double* inputs, const double* shapes, double* values,
                  double* gradients) {
    const int size = system_.size();
    for (int lane = 0; lane < kWidth; ++lane) {
      const int sample = std::min(lane, count - 1);  // unused lanes repeat the last sample
      objective_->load(lane, inputs + sample * system_.input_size());
      system_.numbering.to_internal(shapes + static_cast<std::size_t>(sample) * size, one_.data());
      for (int i = 0; i < size; ++i) set_lane(shapes_[i], lane, one_[i]);
    }
    SweepVisitor idle;
    const auto sums = objective_->value_and_gradient(shapes_.data(), gradients_.data(), idle);
    for (int lane = 0; lane < count; ++lane) values[lane] = sums[lane];
    take(gradients_, count, gradients);
  }

  /// The last gradients times the seed of the inverse Hessian there, and their products.
  void precondition(int count, const double* inputs, double* products, double* images) {
    using Single = typename LaneObjective<Real>::Single;
    for (int lane = 0; lane < kWidth; ++lane) {
      const double* input = inputs + std::min(lane, count - 1) * system_.input_size();
      objective_->load_seed(lane, objective_->seed_near(input, lane_of(shapes_, lane).data()));
    }
    std::vector<Single> vectors(gradients_.size());
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i] = cast<float>(gradients_[i]);
    const auto sums = objective_->precondition(vectors.data(), vectors.data());
    for (int lane = 0; lane < count; ++lane) products[lane] = sums[lane];
    take(vectors, count, images);
  }

 private:
  template <class Vector>
  void take(const Vector& from, int count, double* to) {
    const int size = system_.size();
    for (int lane = 0; lane < count; ++lane) {
      for (int i = 0; i < size; ++i) one_[i] = from[i][lane];
      system_.numbering.to_external(one_.data(), to + static_cast<std::size_t>(lane) * size);
    }
  }

  const SampleSystem& system_;
  std::unique_ptr<LaneObjective<Real>> objective_;
  std::vector<Real> shapes_, gradients_;
  std::vector<double> one_;
};

template <class Real>
bool evaluate_pack(const SampleSystem& system, const LaneObjectives& objectives, PackKind kind,
                   int count, const double* inputs, const double* shapes,
                   const PackResults& results) {
  if (kind.width != Real::kWidth || kind.single != std::is_same_v<typename Real::Scalar, float>)
    return false;
  const FlushDenormals flush;
  Evaluation<Real> evaluation(system, objectives);
  evaluation(count, inputs, shapes, results.values, results.gradients);
  evaluation.precondition(count, inputs, results.products, results.images);
  return true;
}

template <class... Real>
bool evaluate_pack(PackList<Real...>, const auto&... arguments) {
  return (evaluate_pack<Real>(arguments...) || ...);
}

}  // namespace

void evaluate(const SampleSystem& system, int count, const double* inputs, const double* shapes,
              double* values, double* gradients, int threads) {
  using Wide = Lanes<kWideLanes>;
  constexpr int kWidth = Wide::kWidth;
  const LaneObjectives objectives = system.lanes();
  const int packs = (count + kWidth - 1) / kWidth, size = system.size();
  const int workers = std::clamp(thread_count(threads), 1, packs);
  std::atomic<int> next{0};
  parallel_for(workers, workers, [&](int) {
    const FlushDenormals flush;
    Evaluation<Wide> evaluation(system, objectives);
    for (int pack = next++; pack < packs; pack = next++) {
      const int first = pack * kWidth;
      evaluation(std::min(kWidth, count - first), inputs + first * system.input_size(),
                 shapes + static_cast<std::size_t>(first) * size, values + first,
                 gradients + static_cast<std::size_t>(first) * size);
    }
  });
}

bool evaluate_in_pack(const SampleSystem& system, PackKind kind, int count, const double* inputs,
                      const double* shapes, const PackResults& results) {
  return evaluate_pack(LanePacks(), system, seeded(system, {}), kind, count, inputs, shapes,
                       results);
}

}  // namespace snapspace
