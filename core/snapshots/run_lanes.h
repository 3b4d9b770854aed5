#pragma once
#include "snapshots/lane_objectives.h"
#include "snapshots/pair_products.h"
#include "snapshots/sample_exchange.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// Solves the samples of an exchange by L-BFGS, one sample per lane, on the caller's thread.
///
/// @param width    samples in a pack at most; the widest of this build that is no wider is taken
/// @param threads  that the objective may use for itself
template <LbfgsMemory memory>
void run_lanes(const LaneObjectives& objectives, int width, const SolveOptions& options,
               int threads, SampleExchange& exchange, const SolveControl& control);

extern template void run_lanes<kShortMemory>(const LaneObjectives&, int, const SolveOptions&, int,
                                             SampleExchange&, const SolveControl&);
extern template void run_lanes<kLongMemory>(const LaneObjectives&, int, const SolveOptions&, int,
                                            SampleExchange&, const SolveControl&);

/// The same for a memory that is known only now.
inline void run_lanes(LbfgsMemory memory, const LaneObjectives& objectives, int width,
                      const SolveOptions& options, int threads, SampleExchange& exchange,
                      const SolveControl& control) {
  if (memory.pairs == kShortMemory.pairs)
    run_lanes<kShortMemory>(objectives, width, options, threads, exchange, control);
  else
    run_lanes<kLongMemory>(objectives, width, options, threads, exchange, control);
}

}  // namespace snapspace
