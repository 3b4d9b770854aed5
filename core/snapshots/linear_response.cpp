#include "snapshots/linear_response.h"

#include <algorithm>

#include "memory/scratch.h"
#include "simd/lanes.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Few, since most problems have six inputs, and two threads.
constexpr int kLanes = 4;
using Real = SingleLanes<kLanes>;
using Total = Lanes<kLanes>;
using Column = StreamedVector<Real>;

constexpr int kMostSteps = 200;
/// Decrease of the energy in a step that ends the solve, as a share of that in all steps but the
/// first, in which the handles move. On the Dragon it is 20 steps; starts from exact responses need
/// as many evaluations.
constexpr double kEnough = 3e-4;

/// Lane by lane; nothing where there is no divisor.
Total quotient(Total a, Total b) {
  Total result(0.0);
  for (int lane = 0; lane < kLanes; ++lane)
    if (b[lane] > 0.0) result.set(lane, a[lane] / b[lane]);
  return result;
}

bool negligible(Total gain, Total all) {
  for (int lane = 0; lane < kLanes; ++lane)
    if (gain[lane] > kEnough * all[lane]) return false;
  return true;
}

/// The right-hand sides become what is left of them, and x their solutions by conjugate gradients,
/// each by itself.
void solve(const PosingSystem& system, Column& residual, Column& x) {
  const std::size_t size = x.size();
  Column preconditioned(size, Real(0)), search(size, Real(0)), product(size, Real(0));
  Scratch scratch;
  Total norm(0.0), all(0.0);
  for (int step = 0; step < kMostSteps; ++step) {
    const Total next = system.inverse.apply(residual.data(), preconditioned.data(), scratch);
    const Real turn = cast<float>(quotient(next, norm));
    norm = next;
    for (std::size_t i = 0; i < size; ++i) search[i] = preconditioned[i] + turn * search[i];
    system.rest_hessian_product(search.data(), product.data());
    Total curvature(0.0);
    for (std::size_t i = 0; i < size; ++i) curvature += widened(search[i] * product[i]);
    const Total length = quotient(norm, curvature);
    const Real step_length = cast<float>(length);
    for (std::size_t i = 0; i < size; ++i) {
      x[i] += step_length * search[i];
      residual[i] -= step_length * product[i];
    }
    if (step == 0) continue;
    all += length * norm;
    if (negligible(length * norm, all)) break;
  }
}

}  // namespace

LinearResponse::LinearResponse(const PosingSystem& system, const double* inputs, int count)
    : count_(count), entries_(static_cast<std::size_t>(system.size()) * count) {
  parallel_for((count + kLanes - 1) / kLanes, 0, [&](int pack) {
    const FlushDenormals flush;
    const int first = pack * kLanes, used = std::min(kLanes, count - first);
    Column forces(size(), Real(0)), x(size(), Real(0));
    for (std::size_t k = 0; k < system.pinned.size(); ++k)
      for (int c = 0; c < 3; ++c)
        for (int lane = 0; lane < used; ++lane) {
          const double* input = inputs + std::size_t(first + lane) * system.input_size();
          set_lane(forces[3 * std::size_t(system.pinned[k]) + c], lane,
                   2.0 * system.weights[k] * input[3 * k + c]);
        }
    solve(system, forces, x);
    for (std::size_t i = 0; i < size(); ++i)
      for (int lane = 0; lane < used; ++lane) entries_[i * count + first + lane] = x[i][lane];
  });
}

}  // namespace snapspace
