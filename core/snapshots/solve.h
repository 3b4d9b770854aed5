#pragma once
#include "snapshots/coarse_space.h"
#include "snapshots/sample_queue.h"
#include "snapshots/sample_system.h"
#include "snapshots/soft_modes.h"
#include "snapshots/solve_report.h"

namespace snapspace {

class LaneObjectives;

/// What is added to the inverse of the scalar matrix: soft modes that all samples share, or the
/// inverse Hessian of each sample on a coarse space, or else on the system's patches, if it has
/// any. With a coarse space, the input of a sample is that of the system followed by this inverse,
/// see `on_two_levels`.
struct LowRankSeed {
  const SoftModes* modes = nullptr;
  const CoarseSpace* coarse = nullptr;
};

/// Objectives of a system with this seed. They refer to all of these.
[[nodiscard]] LaneObjectives seeded(const SampleSystem& system, const LowRankSeed& seed);

/// Solves the samples of a queue until it is closed and empty, or the control cancels, by L-BFGS on
/// the scalar factor: one sample per lane, and a pack of lanes per thread. The result of a sample
/// does not depend on the number of threads or on which samples are solved together.
/// @param expected  number of samples that will come in all; with few samples, each pack gets
///                  several threads
void solve_fast(const SampleSystem& system, const LowRankSeed& seed, SampleQueue& queue,
                int expected, const SolveOptions& options, SolveControl& control);

/// The same by Newton's method, one sample per thread at a time.
/// @return  conjugate gradient iterations of all samples together
long solve_newton(const SampleSystem& system, SampleQueue& queue, int expected,
                  const SolveOptions& options, const HessianOptions& hessian,
                  SolveControl& control);

}  // namespace snapspace
