#include "snapshots/solve.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "snapshots/lbfgs.h"
#include "snapshots/newton.h"
#include "snapshots/softened_system.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

int thread_count(int wanted) {
  return wanted > 0 ? wanted : std::max(1u, std::thread::hardware_concurrency());
}

/// Packs of two samples or more: alone in a pack, a sample would cost nearly as much as two.
int pack_count(int expected, int threads) { return std::clamp((expected + 1) / 2, 1, threads); }

/// What one solver needs of a queue, in the numbering of the system. From taking a sample to
/// handing over its solution no memory is asked for: new memory takes longer than what is done with
/// it.
template <class System>
class Exchange {
 public:
  Exchange(const System& system, SampleQueue& queue, SolveControl& control)
      : system_(system), queue_(queue), control_(control) {}

  [[nodiscard]] std::optional<Sample> take(int held) {
    std::optional<Sample> sample = queue_.take(held, control_);
    if (sample) {
      system_.numbering.to_internal(sample->start.data(), spare_.data());
      sample->start.swap(spare_);
    }
    return sample;
  }

  [[nodiscard]] bool exhausted() const { return queue_.exhausted(); }

  void tell(int id, int evaluations) const { queue_.tell(id, evaluations); }

  void finish(int id, SolveReport report, std::vector<double> shape) {
    report.inverted_tets = system_.inverted_tets(shape.data());
    system_.numbering.to_external(shape.data(), spare_.data());
    shape.swap(spare_);
    queue_.finish({id, report, std::move(shape)});
    ++control_.finished;
  }

 private:
  const System& system_;
  SampleQueue& queue_;
  SolveControl& control_;
  std::vector<double> spare_ = std::vector<double>(system_.size());  // a shape
};

/// @param seeded  the system itself, or with another seed of its inverse Hessians
template <class Real, class System, class Seeded>
void solve_in_lanes(const System& system, const Seeded& seeded, SampleQueue& queue, int expected,
                    const SolveOptions& options, SolveControl& control) {
  const int threads = thread_count(options.threads), packs = pack_count(expected, threads);
  queue.share(packs);
  parallel_for(packs, packs, [&](int) {
    const FlushDenormals flush;
    Exchange exchange(system, queue, control);
    LaneLbfgs<Seeded, Real>(seeded, options, threads / packs).run(exchange, control);
  });
}

/// Packs that hold the samples, as wide as is wanted and as this build has. Width does not change
/// results; packs get narrower by themselves towards the end.
template <class T, class System, class Seeded>
void solve_in_packs(const System& system, const Seeded& seeded, SampleQueue& queue, int expected,
                    const SolveOptions& options, SolveControl& control) {
  constexpr int kWidest = kWideLanes * static_cast<int>(sizeof(double) / sizeof(T));
  const int packs = pack_count(expected, thread_count(options.threads));
  const int width = std::min(options.lanes, (expected + packs - 1) / packs);
  if constexpr (kWidest >= 16)
    if (width > 8)
      return solve_in_lanes<Pack<T, 16>>(system, seeded, queue, expected, options, control);
  if constexpr (kWidest >= 8)
    if (width > 4)
      return solve_in_lanes<Pack<T, 8>>(system, seeded, queue, expected, options, control);
  if constexpr (kWidest >= 4)
    if (width > 2)
      return solve_in_lanes<Pack<T, 4>>(system, seeded, queue, expected, options, control);
  solve_in_lanes<Pack<T, 2>>(system, seeded, queue, expected, options, control);
}

template <class System, class Seeded>
void solve_in_precision(const System& system, const Seeded& seeded, SampleQueue& queue,
                        int expected, const SolveOptions& options, SolveControl& control) {
  if (options.single)
    solve_in_packs<float>(system, seeded, queue, expected, options, control);
  else
    solve_in_packs<double>(system, seeded, queue, expected, options, control);
}

}  // namespace

template <class System>
void solve_fast(const System& system, const SoftModes* modes, SampleQueue& queue, int expected,
                const SolveOptions& options, SolveControl& control) {
  if (modes)
    solve_in_precision(system, SoftenedSystem<System>{system, *modes}, queue, expected, options,
                       control);
  else
    solve_in_precision(system, system, queue, expected, options, control);
}

template <class System>
long solve_newton(const System& system, SampleQueue& queue, int expected,
                  const SolveOptions& options, double clamp, SolveControl& control) {
  std::atomic<long> linear_iterations{0};
  const int workers = std::clamp(expected, 1, thread_count(options.threads));
  queue.share(workers);
  parallel_for(workers, workers, [&](int) {
    const FlushDenormals flush;
    Exchange exchange(system, queue, control);
    using Objective = typename System::template Objective<double>;
    Newton<Objective> solver(Objective(system), options, clamp);
    while (const std::optional<Sample> sample = exchange.take(0)) {
      const SolveReport report = solver.solve(*sample, control);
      if (report.status == SolveStatus::cancelled) break;
      exchange.finish(sample->id, report, solver.shape());
    }
    linear_iterations += solver.linear_iterations();
  });
  return linear_iterations;
}

template void solve_fast(const PosingSystem&, const SoftModes*, SampleQueue&, int,
                         const SolveOptions&, SolveControl&);
template void solve_fast(const InterpolationSystem&, const SoftModes*, SampleQueue&, int,
                         const SolveOptions&, SolveControl&);
template long solve_newton(const PosingSystem&, SampleQueue&, int, const SolveOptions&, double,
                           SolveControl&);
template long solve_newton(const InterpolationSystem&, SampleQueue&, int, const SolveOptions&,
                           double, SolveControl&);

}  // namespace snapspace
