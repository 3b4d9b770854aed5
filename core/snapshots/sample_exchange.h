#pragma once
#include <optional>
#include <vector>

#include "snapshots/sample_queue.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// Where a solver gets its samples and returns their solutions. Shapes are in the internal
/// numbering.
class SampleExchange {
 public:
  virtual ~SampleExchange() = default;
  /// The next sample, if any, for a solver that works on `held` samples.
  [[nodiscard]] virtual std::optional<Sample> take(int held) = 0;
  /// Whether no more samples will come.
  [[nodiscard]] virtual bool exhausted() const = 0;
  /// Reports how many evaluations a sample has had so far.
  virtual void report_evaluations(int id, int evaluations) = 0;
  virtual void finish(int id, SolveReport report, std::vector<double> shape) = 0;
};

}  // namespace snapspace
