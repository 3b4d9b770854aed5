#include "snapshots/solve.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "snapshots/lbfgs.h"
#include "snapshots/newton.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

template <class System>
std::size_t offset(const System& system, int sample) {
  return static_cast<std::size_t>(sample) * system.size();
}

int thread_count(int wanted) {
  return wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

template <int Width, class System>
std::vector<SolveReport> solve_in_lanes(const System& system, const Samples& samples,
                                        const SolveOptions& options, SolveControl& control) {
  std::vector<SolveReport> reports(samples.count);
  std::atomic<int> next{0};
  // No more groups of lanes than hold the samples.
  const int threads = thread_count(options.threads);
  const int groups = std::min((samples.count + Width - 1) / Width, threads);
  parallel_for(groups, groups, [&](int) {
    const FlushDenormals flush;
    using Objective = typename System::template Objective<Lanes<Width>>;
    LaneLbfgs<Objective, Width> solver(Objective(system, samples, threads / groups), options);
    const auto take = [&] {
      const int sample = next++;
      return sample < samples.count ? sample : -1;
    };
    std::vector<double> shape(system.size());
    const auto start = [&](int sample) {
      system.numbering.to_internal(samples.starts + offset(system, sample), shape.data());
      return shape.data();
    };
    const auto finish = [&](int sample, SolveReport report, const auto& write) {
      write(shape.data());
      report.inverted_tets = system.inverted_tets(shape.data());
      system.numbering.to_external(shape.data(), samples.shapes + offset(system, sample));
      reports[sample] = report;
      ++control.finished;
    };
    solver.run(take, start, finish, control);
  });
  return reports;
}

}  // namespace

template <class System>
std::vector<SolveReport> solve_fast(const System& system, const Samples& samples,
                                    const SolveOptions& options, SolveControl& control) {
  if constexpr (kWideLanes >= 8)
    if (options.lanes >= 8) return solve_in_lanes<8>(system, samples, options, control);
  if constexpr (kWideLanes >= 4)
    if (options.lanes >= 4) return solve_in_lanes<4>(system, samples, options, control);
  return solve_in_lanes<2>(system, samples, options, control);
}

template <class System>
std::vector<SolveReport> solve_newton(const System& system, const Samples& samples,
                                      const SolveOptions& options, double clamp,
                                      SolveControl& control, long* linear_iterations) {
  std::vector<SolveReport> reports(samples.count);
  std::atomic<int> next{0};
  std::atomic<long> total{0};
  const int workers = std::min(samples.count, thread_count(options.threads));
  parallel_for(workers, workers, [&](int) {
    const FlushDenormals flush;
    using Objective = typename System::template Objective<double>;
    Newton<Objective> solver(Objective(system, samples), options, clamp);
    std::vector<double> start(system.size());
    for (int sample = next++; sample < samples.count && !control.cancelled; sample = next++) {
      system.numbering.to_internal(samples.starts + offset(system, sample), start.data());
      SolveReport report = solver.solve(sample, start.data(), control);
      if (report.status == SolveStatus::cancelled) break;
      report.inverted_tets = system.inverted_tets(solver.shape().data());
      system.numbering.to_external(solver.shape().data(), samples.shapes + offset(system, sample));
      reports[sample] = report;
      ++control.finished;
    }
    total += solver.linear_iterations();
  });
  if (linear_iterations) *linear_iterations = total;
  return reports;
}

template std::vector<SolveReport> solve_fast(const PosingSystem&, const Samples&,
                                             const SolveOptions&, SolveControl&);
template std::vector<SolveReport> solve_fast(const InterpolationSystem&, const Samples&,
                                             const SolveOptions&, SolveControl&);
template std::vector<SolveReport> solve_newton(const PosingSystem&, const Samples&,
                                               const SolveOptions&, double, SolveControl&, long*);
template std::vector<SolveReport> solve_newton(const InterpolationSystem&, const Samples&,
                                               const SolveOptions&, double, SolveControl&, long*);

}  // namespace snapspace
