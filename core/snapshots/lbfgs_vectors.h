#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"
#include "snapshots/pair_products.h"

namespace snapspace {

/// The vectors of L-BFGS for all lanes, of which PairProducts knows the inner products.
///
/// The solver is bound by the time it takes to stream them. So they lie interleaved, entry by
/// entry, and a step has two passes over them: one for the products, one for all combinations. All
/// but the points are kept in single precision, which perturbs the approximation of the inverse
/// Hessian by 1e-7 and the result of the solve not at all. The steps are those that the points have
/// made, with their rounding: that is what stiff handles answer.
template <class Real>
class LbfgsVectors {
 public:
  static constexpr int kWidth = Real::kWidth;
  static constexpr int kPairs = PairProducts::kPairs;
  using Total = Lanes<kWidth>;
  using Single = SingleLanes<kWidth>;

  /// Inner products with the gradient of a trial.
  struct Products {
    Total itself, direction, steps[kPairs - 1], images[kPairs];
  };

  /// What a step did in each lane.
  struct Outcome {
    Real accepted{0};  ///< not zero: the lane is at its trial now
    Total next_length{0.0};
    Total scale{1.0};  ///< A^-1 gradient = scale * image
  };

  /// Squares of lengths in the norm of the masses: of the directions, and of the trials.
  struct Lengths {
    Total direction{0.0}, trial{0.0};
  };

  /// @param masses  one per vertex, which has three entries
  explicit LbfgsVectors(std::vector<float> masses)
      : masses_(std::move(masses)), entries_(3 * masses_.size(), Entry{}) {}

  /// Takes over everything from the lanes of wider vectors.
  template <class Wide>
  void take_lanes(const LbfgsVectors<Wide>& from, const std::vector<int>& lanes) {
    for (int lane = 0; lane < static_cast<int>(lanes.size()); ++lane) {
      const int there = lanes[lane];
      for (std::size_t i = 0; i < entries_.size(); ++i) {
        Entry& to = entries_[i];
        const auto& source = from.entries_[i];
        to.u.set(lane, source.u[there]);
        to.direction.set(lane, source.direction[there]);
        for (int k = 0; k < kPairs; ++k) to.images[k].set(lane, source.images[k][there]);
        for (int k = 0; k < kPairs - 1; ++k) to.steps[k].set(lane, source.steps[k][there]);
      }
    }
  }

  /// A lane's point, entry i. What its last sample has left in the other vectors is finite, and
  /// has no weight.
  void place(int lane, int i, double value) { set_lane(entries_[i].u, lane, value); }
  [[nodiscard]] double at(int lane, int i) const { return entries_[i].u[lane]; }

  /// Products of a trial's gradient with itself and the vectors.
  /// @param scaled  becomes shrink * gradient; may be the same array
  Products products(const Real* gradient, Total shrink, Single* scaled) const;

  /// After a step: new points and directions, and for all lanes
  ///   trial = u + next_length * direction.
  /// @param image  A^-1 gradient / scale of the trial
  /// @param pairs  have the coefficients of the new directions, one per lane
  /// @return       of what is new now
  Lengths combine(const Outcome& outcome, const Single* image, const PairProducts* pairs,
                  Real* trial);

 private:
  template <class>
  friend class LbfgsVectors;

  struct Entry {
    Real u{0};
    Single direction{0};         // from u
    Single images[kPairs]{};     // A^-1 gradient at u, and at the points before
    Single steps[kPairs - 1]{};  // that led to u, and to the points before; newest first, as images
  };

  /// In the precision of shapes.
  template <class T>
  static Real narrowed(Pack<T, kWidth> a) {
    return cast<typename Real::Scalar>(a);
  }

  std::vector<float> masses_;
  StreamedVector<Entry> entries_;
};

template <class Real>
auto LbfgsVectors<Real>::products(const Real* gradient, Total shrink, Single* scaled) const
    -> Products {
  const Real factor = narrowed(shrink);
  Products sums;
  sums.itself = sums.direction = 0.0;
  for (Total& sum : sums.images) sum = 0.0;
  for (Total& sum : sums.steps) sum = 0.0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Total g = widened(gradient[i]);
    sums.itself += g * g;
    sums.direction += g * widened(entries_[i].direction);
    for (int k = 0; k < kPairs; ++k) sums.images[k] += g * widened(entries_[i].images[k]);
    for (int k = 0; k < kPairs - 1; ++k) sums.steps[k] += g * widened(entries_[i].steps[k]);
    scaled[i] = cast<float>(gradient[i] * factor);
  }
  return sums;
}

template <class Real>
auto LbfgsVectors<Real>::combine(const Outcome& outcome, const Single* image,
                                 const PairProducts* pairs, Real* trial) -> Lengths {
  Real step_weights[kPairs], image_weights[kPairs];
  for (int k = 0; k < kPairs; ++k)
    for (int lane = 0; lane < kWidth; ++lane) {
      set_lane(step_weights[k], lane, pairs[lane].step[k]);
      set_lane(image_weights[k], lane, pairs[lane].image[k]);
    }
  const Real scale = narrowed(outcome.scale), accepted = outcome.accepted;
  const Real next_length = narrowed(outcome.next_length);
  const auto turn = [&](std::size_t i) {
    Entry& entry = entries_[i];
    const Real z = scale * narrowed(image[i]), s = trial[i] - entry.u;
    Real direction = -z, newer = z;
    for (int k = 0; k < kPairs; ++k) {
      const Real older = narrowed(entry.images[k]);
      const Real step = k == 0 ? s : narrowed(entry.steps[k - 1]);
      direction += image_weights[k] * (newer - older) + step_weights[k] * step;
      newer = older;
    }
    const auto accept = [&](Single& held, Real fresh) {
      held = cast<float>(select(accepted, fresh, narrowed(held)));
    };
    for (int k = kPairs - 1; k > 0; --k) accept(entry.images[k], narrowed(entry.images[k - 1]));
    for (int k = kPairs - 2; k > 0; --k) accept(entry.steps[k], narrowed(entry.steps[k - 1]));
    accept(entry.images[0], z);
    accept(entry.steps[0], s);
    accept(entry.direction, direction);
    entry.u = select(accepted, trial[i], entry.u);
    trial[i] = entry.u + next_length * narrowed(entry.direction);
  };
  Lengths lengths;
  for (std::size_t vertex = 0; vertex < masses_.size(); ++vertex) {
    const Total mass(masses_[vertex]);
    for (std::size_t i = 3 * vertex; i < 3 * vertex + 3; ++i) {
      turn(i);
      const Total direction = widened(entries_[i].direction);
      const Total displacement = widened(trial[i]);
      lengths.direction += mass * direction * direction;
      lengths.trial += mass * displacement * displacement;
    }
  }
  return lengths;
}

}  // namespace snapspace
