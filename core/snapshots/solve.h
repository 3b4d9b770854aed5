#pragma once
#include <vector>

#include "snapshots/interpolation_system.h"
#include "snapshots/posing_system.h"
#include "snapshots/samples.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// Full-space solutions of all samples by L-BFGS on the scalar factor, one sample per lane, threads
/// over groups of lanes. One report per sample. The results do not depend on the number of threads,
/// nor on which samples are solved together.
///
/// @tparam System  PosingSystem or InterpolationSystem
template <class System>
[[nodiscard]] std::vector<SolveReport> solve_fast(const System& system, const Samples& samples,
                                                  const SolveOptions& options,
                                                  SolveControl& control);

/// The same by the paper's Newton method, one sample per thread at a time.
/// @param linear_iterations  receives the conjugate gradient iterations of all samples together
template <class System>
[[nodiscard]] std::vector<SolveReport> solve_newton(const System& system, const Samples& samples,
                                                    const SolveOptions& options, double clamp,
                                                    SolveControl& control,
                                                    long* linear_iterations = nullptr);

extern template std::vector<SolveReport> solve_fast(const PosingSystem&, const Samples&,
                                                    const SolveOptions&, SolveControl&);
extern template std::vector<SolveReport> solve_fast(const InterpolationSystem&, const Samples&,
                                                    const SolveOptions&, SolveControl&);
extern template std::vector<SolveReport> solve_newton(const PosingSystem&, const Samples&,
                                                      const SolveOptions&, double, SolveControl&,
                                                      long*);
extern template std::vector<SolveReport> solve_newton(const InterpolationSystem&, const Samples&,
                                                      const SolveOptions&, double, SolveControl&,
                                                      long*);

}  // namespace snapspace
