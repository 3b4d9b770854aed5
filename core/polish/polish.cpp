#include "polish/polish.h"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "polish/two_level_system.h"
#include "snapshots/lbfgs.h"
#include "threads/flush_denormals.h"

namespace snapspace {

namespace {

/// Hands one sample to a solver and keeps its solution.
struct OneSample {
  std::optional<Sample> waiting;
  bool finished = false;
  SolveReport report = {};
  std::vector<double> shape = {};

  std::optional<Sample> take(int) { return std::exchange(waiting, std::nullopt); }
  [[nodiscard]] bool exhausted() const { return !waiting.has_value(); }
  void tell(int, int) const {}
  void finish(int, const SolveReport& how, std::vector<double> solution) {
    finished = true;
    report = how;
    shape = std::move(solution);
  }
};

}  // namespace

template <class System>
Solution polish(const System& system, const CoarseSpace& coarse, const Eigen::MatrixXf& inverse,
                const Sample& sample, const SolveOptions& options, const SolveControl& control) {
  const FlushDenormals flush;
  OneSample exchange{sample};
  system.numbering.to_internal(sample.start.data(), exchange.waiting->start.data());
  LowestShape lowest;
  const TwoLevelSystem<System> two_level{system, coarse, inverse, lowest};
  LaneLbfgs<TwoLevelSystem<System>, Lanes<2>>(two_level, options, options.threads)
      .run(exchange, control);

  Solution result{sample.id, {}, sample.start};
  std::vector<double> internal = std::move(lowest.shape);
  if (exchange.finished) {
    result.report = exchange.report;
    internal = std::move(exchange.shape);
  } else {  // cancelled: not every evaluation was a step
    result.report.value = lowest.value;
    result.report.evaluations = lowest.evaluations;
  }
  if (internal.empty()) return result;  // cancelled before anything was evaluated
  result.report.inverted_tets = system.inverted_tets(internal.data());
  system.numbering.to_external(internal.data(), result.shape.data());
  return result;
}

template Solution polish(const PosingSystem&, const CoarseSpace&, const Eigen::MatrixXf&,
                         const Sample&, const SolveOptions&, const SolveControl&);
template Solution polish(const InterpolationSystem&, const CoarseSpace&, const Eigen::MatrixXf&,
                         const Sample&, const SolveOptions&, const SolveControl&);

}  // namespace snapspace
