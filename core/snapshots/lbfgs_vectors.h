#pragma once
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"
#include "snapshots/pair_products.h"

namespace snapspace {

/// The vectors of L-BFGS for all lanes, of which PairProducts knows the inner products.
///
/// The solver is bound by the time it takes to stream them. So they lie interleaved, entry by
/// entry, and a step touches them twice: for all combinations, and for the products. Both are
/// functions of a range of vertices, called where the objective's pass over the mesh is: most of
/// the second finds what the first has left in a cache. All but the points are kept in single
/// precision, which perturbs the approximation of the inverse Hessian by 1e-7 and the result of the
/// solve not at all. Neither the newest step nor the direction is kept: a trial differs from its
/// point by the step, with the rounding of both, which is what stiff handles answer.
template <class Real, LbfgsMemory memory>
class LbfgsVectors {
 public:
  static constexpr int kWidth = Real::kWidth;
  static constexpr int kPairs = memory.pairs;
  static constexpr int kSteps = kPairs - 1;  // kept; the newest is what a trial differs by
  using Total = Lanes<kWidth>;
  using Single = SingleLanes<kWidth>;

  /// Inner products with the gradient of a trial, and squares of lengths in the norm of the masses.
  struct Products {
    Total itself{0.0}, images[kPairs];
    Total newest{0.0};                ///< with the step that leads to the trial
    std::array<Total, kSteps> steps;  ///< with those before
    Total step_square{0.0};           ///< of the newest step
    Total trial_square{0.0};          ///< of the displacement at the trial
    Products() {
      for (Total& sum : steps) sum = 0.0;
      for (Total& sum : images) sum = 0.0;
    }
  };

  /// What a step did in each lane.
  struct Outcome {
    Real accepted{0};        ///< not zero: the lane is at its trial now
    Real going{0};           ///< not zero: it has a next trial that is not its point
    Total next_length{0.0};  ///< of the step there: as a share of the new direction, or for lanes
                             ///< that are not accepted of the step that was refused
    Total scale{1.0};        ///< A^-1 gradient = scale * image

    /// Coefficients of the new directions.
    Real seed{1}, step_weights[kPairs]{}, image_weights[kPairs]{};
    void weigh(int lane, const PairProducts<memory>& pairs) {
      set_lane(seed, lane, pairs.seed);
      for (int k = 0; k < kPairs; ++k) {
        set_lane(step_weights[k], lane, pairs.step[k]);
        set_lane(image_weights[k], lane, pairs.image[k]);
      }
    }
  };

  [[nodiscard]] int vertices() const { return static_cast<int>(masses_.size()); }

  /// @param masses  one per vertex, which has three entries
  explicit LbfgsVectors(std::vector<float> masses)
      : masses_(std::move(masses)), entries_(3 * masses_.size(), Entry{}) {}

  /// Takes over everything from the lanes of wider vectors.
  template <class Wide>
  void take_lanes(const LbfgsVectors<Wide, memory>& from, const std::vector<int>& lanes) {
    for (int lane = 0; lane < static_cast<int>(lanes.size()); ++lane) {
      const int there = lanes[lane];
      for (std::size_t i = 0; i < entries_.size(); ++i) {
        Entry& to = entries_[i];
        const auto& source = from.entries_[i];
        to.u.set(lane, source.u[there]);
        for (int k = 0; k < kPairs; ++k) to.images[k].set(lane, source.images[k][there]);
        for (int k = 0; k < kSteps; ++k) to.steps[k].set(lane, source.steps[k][there]);
      }
    }
  }

  /// A lane's point, entry i. What its last sample has left in the other vectors is finite, and
  /// has no weight.
  void place(int lane, int i, double value) { set_lane(entries_[i].u, lane, value); }
  [[nodiscard]] double at(int lane, int i) const { return entries_[i].u[lane]; }

  /// Adds a range's part of the products of a trial's gradient with itself and the vectors.
  /// @param scaled  becomes shrink * gradient there; may be the same array
  void add_products(int begin, int end, const Real* trial, const Real* gradient, Total shrink,
                    Single* scaled, Products& sums) const;

  /// After a step, in a range: new points and new trials.
  /// @param image  A^-1 gradient / scale of the trial
  void combine(int begin, int end, const Outcome& outcome, const Single* image, Real* trial);

 private:
  template <class, LbfgsMemory>
  friend class LbfgsVectors;

  /// Vertices whose products are added in the precision of shapes.
  static constexpr int kChunk = 16;

  struct Entry {
    Real u{0};
    Single images[kPairs]{};  // A^-1 gradient at u, and at the points before
    /// That led to u, and to the points before; newest first, as images.
    [[no_unique_address]] std::array<Single, kSteps> steps{};
  };

  /// In the precision of shapes.
  template <class T>
  static Real narrowed(Pack<T, kWidth> a) {
    return cast<typename Real::Scalar>(a);
  }

  std::vector<float> masses_;
  StreamedVector<Entry> entries_;
};

template <class Real, LbfgsMemory memory>
void LbfgsVectors<Real, memory>::add_products(int begin, int end, const Real* trial,
                                              const Real* gradient, Total shrink, Single* scaled,
                                              Products& all) const {
  const Real factor = narrowed(shrink);
  Total itself = all.itself;  // in registers
  for (int first = begin; first < end; first += kChunk) {
    // The products are energies, of a few vertices here: they may be added in the precision of
    // shapes.
    Real newest(0), images[kPairs], step_square(0), trial_square(0);
    std::array<Real, kSteps> steps;
    for (Real& image : images) image = Real(0);
    for (Real& step : steps) step = Real(0);
    for (int vertex = first; vertex < std::min(first + kChunk, end); ++vertex) {
      const Real mass(static_cast<typename Real::Scalar>(masses_[vertex]));
      for (std::size_t i = 3 * std::size_t(vertex); i < 3 * std::size_t(vertex) + 3; ++i) {
        const Entry& entry = entries_[i];
        const Real g = gradient[i], x = trial[i], s = x - entry.u;
        newest += g * s;
        for (int k = 0; k < kPairs; ++k) images[k] += g * narrowed(entry.images[k]);
        for (int k = 0; k < kSteps; ++k) steps[k] += g * narrowed(entry.steps[k]);
        step_square += mass * s * s;
        trial_square += mass * x * x;
        itself += widened(g) * widened(g);
        scaled[i] = cast<float>(g * factor);
      }
    }
    all.newest += widened(newest);
    for (int k = 0; k < kPairs; ++k) all.images[k] += widened(images[k]);
    for (int k = 0; k < kSteps; ++k) all.steps[k] += widened(steps[k]);
    all.step_square += widened(step_square);
    all.trial_square += widened(trial_square);
  }
  all.itself = itself;
}

template <class Real, LbfgsMemory memory>
void LbfgsVectors<Real, memory>::combine(int begin, int end, const Outcome& outcome,
                                         const Single* image, Real* trial) {
  const Outcome now = outcome;  // which no store can change
  const Real scale = narrowed(now.scale), accepted = now.accepted, going = now.going;
  const Real next_length = narrowed(now.next_length);
  for (std::size_t i = 3 * std::size_t(begin); i < 3 * std::size_t(end); ++i) {
    Entry& entry = entries_[i];
    const Real z = scale * narrowed(image[i]), s = trial[i] - entry.u;
    Real direction = rounded(-now.seed * z), newer = z;
    for (int k = 0; k < kPairs; ++k) {
      const Real older = narrowed(entry.images[k]);
      const Real step = k == 0 ? s : narrowed(entry.steps[k - 1]);
      direction += now.image_weights[k] * (newer - older) + now.step_weights[k] * step;
      newer = older;
    }
    const auto accept = [&](Single& held, Real fresh) {
      held = cast<float>(select(accepted, fresh, narrowed(held)));
    };
    for (int k = kPairs - 1; k > 0; --k) accept(entry.images[k], narrowed(entry.images[k - 1]));
    for (int k = kSteps - 1; k > 0; --k) accept(entry.steps[k], narrowed(entry.steps[k - 1]));
    accept(entry.images[0], z);
    if constexpr (kSteps > 0) accept(entry.steps[0], s);
    entry.u = select(accepted, trial[i], entry.u);
    // of a lane that goes nowhere the trial may be anything
    trial[i] = select(going, entry.u + next_length * select(accepted, direction, s), entry.u);
  }
}

}  // namespace snapspace
