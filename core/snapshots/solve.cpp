#include "snapshots/solve.h"

#include <algorithm>
#include <atomic>
#include <utility>

#include "snapshots/newton.h"
#include "snapshots/patched.h"
#include "snapshots/run_lanes.h"
#include "snapshots/softened.h"
#include "snapshots/two_level.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Packs have at least two samples: alone in a pack, a sample would cost nearly as much as two.
int pack_count(int expected, int threads) { return std::clamp((expected + 1) / 2, 1, threads); }

/// The queue as one solver sees it, in the numbering of the system. It does not allocate per
/// sample: that would cost more than the copy.
class QueueExchange final : public SampleExchange {
 public:
  QueueExchange(const SampleSystem& system, SampleQueue& queue, SolveControl& control)
      : system_(system), queue_(queue), control_(control) {}

  [[nodiscard]] std::optional<Sample> take(int held) override {
    std::optional<Sample> sample = queue_.take(held, control_);
    if (sample) {
      system_.numbering.to_internal(sample->start.data(), spare_.data());
      sample->start.swap(spare_);
    }
    return sample;
  }

  [[nodiscard]] bool exhausted() const override { return queue_.exhausted(); }

  void report_evaluations(int id, int evaluations) override {
    queue_.report_evaluations(id, evaluations);
  }

  void finish(int id, SolveReport report, std::vector<double> shape) override {
    report.inverted_tets = system_.inverted_tets(shape.data());
    system_.numbering.to_external(shape.data(), spare_.data());
    shape.swap(spare_);
    queue_.finish({id, report, std::move(shape)});
    ++control_.finished;
  }

 private:
  const SampleSystem& system_;
  SampleQueue& queue_;
  SolveControl& control_;
  std::vector<double> spare_ = std::vector<double>(system_.size());  // a shape
};

}  // namespace

LaneObjectives seeded(const SampleSystem& system, const LowRankSeed& seed) {
  if (seed.coarse) return on_two_levels(system.lanes(), system.input_size(), *seed.coarse);
  if (seed.modes) return softened(system.lanes(), *seed.modes);
  return system.patches() ? on_patches(system) : system.lanes();
}

void solve_fast(const SampleSystem& system, const LowRankSeed& seed, SampleQueue& queue,
                int expected, const SolveOptions& options, SolveControl& control) {
  const LaneObjectives objectives = seeded(system, seed);
  // The inverses of samples have the right scale, so that seed is not scaled.
  const LbfgsMemory memory = seed.coarse ? kLongMemory : system.memory();
  const int threads = thread_count(options.threads), packs = pack_count(expected, threads);
  // Wide enough for all samples. The width does not change results, and packs get narrower towards
  // the end.
  const int width = std::min(options.lanes, (expected + packs - 1) / packs);
  queue.share(packs);
  ThreadShare share(threads, packs);
  parallel_for(packs, packs, [&](int) {
    const FlushDenormals flush;
    QueueExchange exchange(system, queue, control);
    run_lanes(memory, objectives, width, options, share, exchange, control);
    share.leave();
  });
}

long solve_newton(const SampleSystem& system, SampleQueue& queue, int expected,
                  const SolveOptions& options, const HessianOptions& hessian,
                  SolveControl& control) {
  std::atomic<long> linear_iterations{0};
  const int workers = std::clamp(expected, 1, thread_count(options.threads));
  queue.share(workers);
  parallel_for(workers, workers, [&](int) {
    const FlushDenormals flush;
    QueueExchange exchange(system, queue, control);
    Newton solver(system, options, hessian);
    while (const std::optional<Sample> sample = exchange.take(0)) {
      const SolveReport report = solver.solve(*sample, control);
      if (report.status == SolveStatus::cancelled) break;
      exchange.finish(sample->id, report, solver.shape());
    }
    linear_iterations += solver.linear_iterations();
  });
  return linear_iterations;
}

}  // namespace snapspace
