#include "polish/polish.h"

#include <optional>
#include <utility>
#include <vector>

#include "polish/lowest_shape.h"
#include "snapshots/run_lanes.h"
#include "snapshots/solve.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Hands one sample to a solver and keeps its solution.
struct OneSample final : SampleExchange {
  std::optional<Sample> waiting;
  bool finished = false;
  SolveReport report = {};
  std::vector<double> shape = {};

  explicit OneSample(Sample sample) : waiting(std::move(sample)) {}

  std::optional<Sample> take(int) override { return std::exchange(waiting, std::nullopt); }
  [[nodiscard]] bool exhausted() const override { return !waiting.has_value(); }
  void report_evaluations(int, int) override {}
  void finish(int, SolveReport solve_report, std::vector<double> solution) override {
    finished = true;
    report = solve_report;
    shape = std::move(solution);
  }
};

}  // namespace

Solution polish(const SampleSystem& system, const CoarseSpace* coarse, const Sample& sample,
                const SolveOptions& options, const SolveControl& control) {
  const FlushDenormals flush;
  OneSample exchange(sample);
  system.numbering.to_internal(sample.start.data(), exchange.waiting->start.data());
  LowestShape lowest;
  // Both inverses have the right scale, so the seed is not scaled.
  run_lanes(kLongMemory, watched(seeded(system, {.coarse = coarse}), lowest), 2, options,
            ThreadShare(thread_count(options.threads), 1), exchange, control);

  Solution result{sample.id, {}, sample.start};
  std::vector<double> internal = std::move(lowest.shape);
  if (exchange.finished) {
    result.report = exchange.report;
    internal = std::move(exchange.shape);
  } else {  // cancelled; not every evaluation was a step
    result.report.value = lowest.value;
    result.report.evaluations = lowest.evaluations;
  }
  if (internal.empty()) return result;  // cancelled before anything was evaluated
  result.report.inverted_tets = system.inverted_tets(internal.data());
  system.numbering.to_external(internal.data(), result.shape.data());
  return result;
}

}  // namespace snapspace
