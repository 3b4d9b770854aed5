#pragma once
// The definition of run_lanes, for the files that instantiate it: solvers are compiled once per
// memory and pack.
#include "snapshots/lbfgs.h"
#include "snapshots/run_lanes.h"

namespace snapspace {

template <LbfgsMemory memory, class Scalar>
void run_packs(const LaneObjectives& objectives, int width, const SolveOptions& options,
               const ThreadShare& threads, SampleExchange& exchange, const SolveControl& control) {
  constexpr int kWidest = kWideLanes * static_cast<int>(sizeof(double) / sizeof(Scalar));
  const auto run = [&]<int Width>() {
    LaneLbfgs<memory, Pack<Scalar, Width>>(objectives, options, threads).run(exchange, control);
  };
  if constexpr (kWidest >= 16)
    if (width > 8) return run.template operator()<16>();
  if constexpr (kWidest >= 8)
    if (width > 4) return run.template operator()<8>();
  if constexpr (kWidest >= 4)
    if (width > 2) return run.template operator()<4>();
  run.template operator()<2>();
}

template <LbfgsMemory memory>
void run_lanes(const LaneObjectives& objectives, int width, const SolveOptions& options,
               const ThreadShare& threads, SampleExchange& exchange, const SolveControl& control) {
  if (options.single)
    run_packs<memory, float>(objectives, width, options, threads, exchange, control);
  else
    run_packs<memory, double>(objectives, width, options, threads, exchange, control);
}

}  // namespace snapspace
