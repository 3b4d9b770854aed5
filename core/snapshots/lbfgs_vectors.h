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
/// entry, and a step has two passes over them: one for the products, one for all combinations. The
/// pairs are kept in single precision, which perturbs the approximation of the inverse Hessian by
/// 1e-7 and the result of the solve not at all.
///
/// The slot that a pair takes goes round with every step, in all lanes alike: what a lane remembers
/// must not depend on its neighbours. A lane that refuses its step keeps what the slot has.
template <class Real>
class LbfgsVectors {
 public:
  static constexpr int kWidth = Real::kWidth;
  static constexpr int kPairs = PairProducts::kPairs;
  using Total = Lanes<kWidth>;
  using Single = SingleLanes<kWidth>;

  /// Inner products with the gradient of a trial.
  struct Products {
    Total itself, direction, steps[kPairs], images[kPairs];
  };

  /// What a step did in each lane.
  struct Outcome {
    Real accepted{0};  ///< not zero: the lane is at its trial now
    Real moved{0};     ///< not zero: and leaves a pair
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
    slot_ = from.slot_;
    for (int lane = 0; lane < static_cast<int>(lanes.size()); ++lane) {
      const int there = lanes[lane];
      for (std::size_t i = 0; i < entries_.size(); ++i) {
        Entry& to = entries_[i];
        const auto& source = from.entries_[i];
        to.u.set(lane, source.u[there]);
        to.direction.set(lane, source.direction[there]);
        to.image.set(lane, source.image[there]);
        for (int k = 0; k < kPairs; ++k) {
          to.steps[k].set(lane, source.steps[k][there]);
          to.images[k].set(lane, source.images[k][there]);
        }
      }
    }
  }

  /// A lane's point, entry i. What its last sample has left in the other vectors is finite, and
  /// has no weight.
  void place(int lane, int i, double value) { set_lane(entries_[i].u, lane, value); }
  [[nodiscard]] double at(int lane, int i) const { return entries_[i].u[lane]; }

  /// The slot of this step's pair.
  [[nodiscard]] int slot() const { return slot_; }

  /// Products of a trial's gradient with itself, the directions and the pairs.
  Products products(const Real* gradient) const;

  /// After a step: new points, pairs and directions, and for all lanes
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
    Real u{0}, direction{0};
    Real image{0};            // A^-1 gradient at u
    Single steps[kPairs]{};   // s of the textbook
    Single images[kPairs]{};  // A^-1 y
  };

  /// In the precision of shapes.
  template <class T>
  static Real narrowed(Pack<T, kWidth> a) {
    return cast<typename Real::Scalar>(a);
  }

  int slot_ = 0;
  std::vector<float> masses_;
  StreamedVector<Entry> entries_;
};

template <class Real>
auto LbfgsVectors<Real>::products(const Real* gradient) const -> Products {
  Products sums;
  sums.itself = sums.direction = 0.0;
  for (int k = 0; k < kPairs; ++k) sums.steps[k] = sums.images[k] = 0.0;
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    const Total g = widened(gradient[i]);
    sums.itself += g * g;
    sums.direction += g * widened(entries_[i].direction);
    for (int k = 0; k < kPairs; ++k) {
      sums.steps[k] += g * widened(entries_[i].steps[k]);
      sums.images[k] += g * widened(entries_[i].images[k]);
    }
  }
  return sums;
}

template <class Real>
auto LbfgsVectors<Real>::combine(const Outcome& outcome, const Single* image,
                                 const PairProducts* pairs, Real* trial) -> Lengths {
  // by age of the slot, so that sums do not depend on where the ring stands
  int slots[kPairs];
  Real step_weights[kPairs], image_weights[kPairs];
  for (int age = 0; age < kPairs; ++age) {
    const int k = slots[age] = (slot_ + kPairs - age) % kPairs;
    for (int lane = 0; lane < kWidth; ++lane) {
      set_lane(step_weights[age], lane, pairs[lane].step[k]);
      set_lane(image_weights[age], lane, pairs[lane].image[k]);
    }
  }
  const Real scale = narrowed(outcome.scale);
  const Real next_length = narrowed(outcome.next_length);
  const Real accepted = outcome.accepted, moved = outcome.moved;
  const int slot = slot_;
  const auto turn = [&](std::size_t i) {
    Entry& entry = entries_[i];
    const Real z = scale * narrowed(image[i]);
    const Real s = select(moved, trial[i] - entry.u, narrowed(entry.steps[slot]));
    const Real p = select(moved, z - entry.image, narrowed(entry.images[slot]));
    Real direction = step_weights[0] * s + image_weights[0] * p - z;
    for (int age = 1; age < kPairs; ++age)
      direction += step_weights[age] * narrowed(entry.steps[slots[age]]) +
                   image_weights[age] * narrowed(entry.images[slots[age]]);
    entry.steps[slot] = cast<float>(s);
    entry.images[slot] = cast<float>(p);
    entry.image = select(accepted, z, entry.image);
    entry.u = select(accepted, trial[i], entry.u);
    entry.direction = select(accepted, direction, entry.direction);
    trial[i] = entry.u + next_length * entry.direction;
  };
  Lengths lengths;
  for (std::size_t vertex = 0; vertex < masses_.size(); ++vertex) {
    const Total mass(masses_[vertex]);
    for (std::size_t i = 3 * vertex; i < 3 * vertex + 3; ++i) {
      turn(i);
      const Total direction = widened(entries_[i].direction), displacement = widened(trial[i]);
      lengths.direction += mass * direction * direction;
      lengths.trial += mass * displacement * displacement;
    }
  }
  slot_ = (slot_ + 1) % kPairs;
  return lengths;
}

}  // namespace snapspace
