#include "snapshots/linear_response.h"

#include <algorithm>
#include <cmath>

#include "energy/power_of_two.h"
#include "memory/scratch.h"
#include "simd/lanes.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Responses per pack: few, since most problems have six inputs, and two threads.
constexpr int kLanes = 4;
using ResponsePack = SingleLanes<kLanes>;
using ResponseSums = Lanes<kLanes>;
using ResponseColumn = StreamedVector<ResponsePack>;

constexpr int kMaxResponseSteps = 400;
/// The solve ends when a step decreases the energy by less than this share of the decrease in all
/// steps except the first, which moves the handles. The Dragon takes 20 steps; starts from exact
/// responses need as many evaluations.
constexpr double kMinGain = 3e-4;
/// The same for shells, where bending has little of the energy and most of the displacement.
constexpr double kMinShellGain = 1e-6;

/// The quotient lane by lane; zero where the divisor is not positive.
ResponseSums quotient(ResponseSums a, ResponseSums b) {
  ResponseSums result(0.0);
  for (int lane = 0; lane < kLanes; ++lane)
    if (b[lane] > 0.0) result.set(lane, a[lane] / b[lane]);
  return result;
}

/// A power of two near the largest force of each input, by which its forces are divided and its
/// response is multiplied. If the unit of length is far from the body's size, the energies of unit
/// motions leave the range of single precision. Powers of two change no digits.
double unit_of(const PosingSystem& system, const double* input) {
  double largest = 0.0;
  for (std::size_t k = 0; k < system.pinned.size(); ++k)
    for (int c = 0; c < 3; ++c)
      largest = std::max(largest, std::abs(2.0 * system.weights[k] * input[3 * k + c]));
  return power_of_two(largest);
}

bool negligible(ResponseSums gain, ResponseSums all, double least) {
  for (int lane = 0; lane < kLanes; ++lane)
    if (gain[lane] > least * all[lane]) return false;
  return true;
}

/// Solves by conjugate gradients, each lane by itself, and leaves the residuals in place of the
/// right-hand sides.
void solve(const PosingSystem& system, ResponseColumn& residual, ResponseColumn& x) {
  const std::size_t size = x.size();
  ResponseColumn preconditioned(size, ResponsePack(0)), search(size, ResponsePack(0)),
      product(size, ResponsePack(0));
  Scratch scratch;
  ResponseSums norm(0.0), all(0.0);
  const double least = system.energy.rest.shell ? kMinShellGain : kMinGain;
  for (int step = 0; step < kMaxResponseSteps; ++step) {
    const ResponseSums next = system.inverse.apply(residual.data(), preconditioned.data(), scratch);
    const ResponsePack ratio = cast<float>(quotient(next, norm));
    norm = next;
    for (std::size_t i = 0; i < size; ++i) search[i] = preconditioned[i] + ratio * search[i];
    system.rest_hessian_product(search.data(), product.data());
    ResponseSums curvature(0.0);
    for (std::size_t i = 0; i < size; ++i) curvature += widened(search[i] * product[i]);
    const ResponseSums length = quotient(norm, curvature);
    const ResponsePack step_length = cast<float>(length);
    for (std::size_t i = 0; i < size; ++i) {
      x[i] += step_length * search[i];
      residual[i] -= step_length * product[i];
    }
    if (step == 0) continue;
    all += length * norm;
    if (negligible(length * norm, all, least)) break;
  }
}

}  // namespace

LinearResponse::LinearResponse(const PosingSystem& system, const double* inputs, int count)
    : count_(count), entries_(static_cast<std::size_t>(system.size()) * count) {
  parallel_for((count + kLanes - 1) / kLanes, 0, [&](int pack) {
    const FlushDenormals flush;
    const int first = pack * kLanes, used = std::min(kLanes, count - first);
    ResponseColumn forces(size(), ResponsePack(0)), x(size(), ResponsePack(0));
    double units[kLanes];
    for (int lane = 0; lane < used; ++lane)
      units[lane] = unit_of(system, inputs + std::size_t(first + lane) * system.input_size());
    for (std::size_t k = 0; k < system.pinned.size(); ++k)
      for (int c = 0; c < 3; ++c)
        for (int lane = 0; lane < used; ++lane) {
          const double* input = inputs + std::size_t(first + lane) * system.input_size();
          set_lane(forces[3 * std::size_t(system.pinned[k]) + c], lane,
                   2.0 * system.weights[k] * input[3 * k + c] / units[lane]);
        }
    solve(system, forces, x);
    for (std::size_t i = 0; i < size(); ++i)
      for (int lane = 0; lane < used; ++lane)
        entries_[i * count + first + lane] = static_cast<float>(units[lane] * x[i][lane]);
  });
}

}  // namespace snapspace
