#pragma once
#include "snapshots/lane_objectives.h"
#include "snapshots/pair_products.h"
#include "snapshots/sample_exchange.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// Solves the samples of an exchange by L-BFGS, one sample per lane, on the caller's thread.
/// @param width    maximum number of samples in a pack; the widest such pack of this build is used
/// @param threads  those that the objective may use
template <LbfgsMemory memory>
void run_lanes(const LaneObjectives& objectives, int width, const SolveOptions& options,
               const ThreadShare& threads, SampleExchange& exchange, const SolveControl& control);

extern template void run_lanes<kShortMemory>(const LaneObjectives&, int, const SolveOptions&,
                                             const ThreadShare&, SampleExchange&,
                                             const SolveControl&);
extern template void run_lanes<kLongMemory>(const LaneObjectives&, int, const SolveOptions&,
                                            const ThreadShare&, SampleExchange&,
                                            const SolveControl&);

/// The same for a memory known only at run time.
inline void run_lanes(LbfgsMemory memory, const LaneObjectives& objectives, int width,
                      const SolveOptions& options, const ThreadShare& threads,
                      SampleExchange& exchange, const SolveControl& control) {
  if (memory.pairs == kShortMemory.pairs)
    run_lanes<kShortMemory>(objectives, width, options, threads, exchange, control);
  else
    run_lanes<kLongMemory>(objectives, width, options, threads, exchange, control);
}

}  // namespace snapspace
