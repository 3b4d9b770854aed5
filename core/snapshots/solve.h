#pragma once
#include <vector>

#include "snapshots/interpolation_system.h"
#include "snapshots/posing_system.h"
#include "snapshots/sample_queue.h"
#include "snapshots/soft_modes.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// Solves the samples of a queue until it is closed and empty, or the control cancels: by L-BFGS on
/// the scalar factor, one sample per lane, threads over packs of lanes. The result of a sample does
/// not depend on the number of threads, nor on which samples are solved together.
///
/// @tparam System   PosingSystem or InterpolationSystem
/// @param modes     what the factor mistakes for stiff; may be null
/// @param expected  samples that will come in all; a few leave threads for each other
template <class System>
void solve_fast(const System& system, const SoftModes* modes, SampleQueue& queue, int expected,
                const SolveOptions& options, SolveControl& control);

/// The same by the paper's Newton method, one sample per thread at a time.
/// @return  conjugate gradient iterations of all samples together
template <class System>
long solve_newton(const System& system, SampleQueue& queue, int expected,
                  const SolveOptions& options, double clamp, SolveControl& control);

extern template void solve_fast(const PosingSystem&, const SoftModes*, SampleQueue&, int,
                                const SolveOptions&, SolveControl&);
extern template void solve_fast(const InterpolationSystem&, const SoftModes*, SampleQueue&, int,
                                const SolveOptions&, SolveControl&);
extern template long solve_newton(const PosingSystem&, SampleQueue&, int, const SolveOptions&,
                                  double, SolveControl&);
extern template long solve_newton(const InterpolationSystem&, SampleQueue&, int,
                                  const SolveOptions&, double, SolveControl&);

}  // namespace snapspace
