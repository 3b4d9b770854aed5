#pragma once
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"
#include "snapshots/pair_products.h"

namespace snapspace {

/// The vectors of L-BFGS for all lanes. PairProducts has their inner products.
/// The solver is bound by the time it takes to stream them. So they are interleaved, entry by
/// entry, and a step touches them twice: for all combinations, and for the products. Both are
/// functions of a range of vertices and are called along the objective's pass over the mesh, so the
/// second mostly finds in a cache what the first has written. All except the points are kept in
/// single precision, which perturbs the approximation of the inverse Hessian by 1e-7 and does not
/// change the result of the solve. Neither the newest step nor the direction is kept: the step is
/// the difference of a trial and its point, with the rounding of both, to which stiff handles
/// respond.
template <class Real, LbfgsMemory memory>
class LbfgsVectors {
 public:
  static constexpr int kWidth = Real::kWidth;
  static constexpr int kPairs = memory.pairs;
  static constexpr int kSteps = kPairs - 1;  // kept; the newest is trial - point
  using Total = Lanes<kWidth>;
  using Single = SingleLanes<kWidth>;

  /// Inner products with the gradient of a trial, and squares of lengths in the norm of the masses.
  struct Products {
    Total gradient_square{0.0}, images[kPairs];
    Total newest{0.0};                ///< with the step that leads to the trial
    std::array<Total, kSteps> steps;  ///< with the steps before
    Total step_square{0.0};           ///< squared length of the newest step
    Total trial_square{0.0};          ///< squared length of the displacement at the trial
    Products() {
      for (Total& sum : steps) sum = 0.0;
      for (Total& sum : images) sum = 0.0;
    }
  };

  /// The result of a step in each lane.
  struct Outcome {
    Real accepted{0};        ///< not zero: the lane is now at its trial
    Real continues{0};       ///< not zero: its next trial differs from its point
    Total next_length{0.0};  ///< of the next step: as a share of the new direction or, in lanes
                             ///< that are not accepted, of the refused step
    Total scale{1.0};        ///< A^-1 gradient = scale * image

    /// Coefficients of the new directions.
    Real seed{1}, step_weights[kPairs]{}, image_weights[kPairs]{};
    void set_weights(int lane, const PairProducts<memory>& pairs) {
      set_lane(seed, lane, pairs.seed);
      for (int k = 0; k < kPairs; ++k) {
        set_lane(step_weights[k], lane, pairs.step[k]);
        set_lane(image_weights[k], lane, pairs.image[k]);
      }
    }
  };

  [[nodiscard]] int vertices() const { return static_cast<int>(masses_.size()); }

  /// @param masses  one per vertex; a vertex has three entries
  explicit LbfgsVectors(std::vector<float> masses)
      : masses_(std::move(masses)), entries_(3 * masses_.size(), Entry{}) {}

  /// Takes over everything from the lanes of wider vectors.
  template <class Wide>
  void take_lanes(const LbfgsVectors<Wide, memory>& from, const std::vector<int>& lanes) {
    for (int lane = 0; lane < static_cast<int>(lanes.size()); ++lane) {
      const int source_lane = lanes[lane];
      for (std::size_t i = 0; i < entries_.size(); ++i) {
        Entry& to = entries_[i];
        const auto& source = from.entries_[i];
        to.u.set(lane, source.u[source_lane]);
        for (int k = 0; k < kPairs; ++k) to.images[k].set(lane, source.images[k][source_lane]);
        for (int k = 0; k < kSteps; ++k) to.steps[k].set(lane, source.steps[k][source_lane]);
      }
    }
  }

  /// Sets entry i of a lane's point. The other vectors keep the data of its last sample, which are
  /// finite and have no weight.
  void place(int lane, int i, double value) { set_lane(entries_[i].u, lane, value); }
  [[nodiscard]] double at(int lane, int i) const { return entries_[i].u[lane]; }

  /// Adds a range's part of the products of a trial's gradient with itself and with the vectors.
  /// @param scaled  set to shrink * gradient in the range; may be the same array
  void add_products(int begin, int end, const Real* trial, const Real* gradient, Total shrink,
                    Single* scaled, Products& sums) const;

  /// Updates points and trials after a step, in a range.
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
    /// The steps that led to u and to the points before; newest first, like the images.
    [[no_unique_address]] std::array<Single, kSteps> steps{};
  };

  /// A pack in the precision of shapes.
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
  Total square = all.gradient_square;  // in registers
  for (int first = begin; first < end; first += kChunk) {
    // The products are energies, here of a few vertices, so the precision of shapes suffices.
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
        square += widened(g) * widened(g);
        scaled[i] = cast<float>(g * factor);
      }
    }
    all.newest += widened(newest);
    for (int k = 0; k < kPairs; ++k) all.images[k] += widened(images[k]);
    for (int k = 0; k < kSteps; ++k) all.steps[k] += widened(steps[k]);
    all.step_square += widened(step_square);
    all.trial_square += widened(trial_square);
  }
  all.gradient_square = square;
}

template <class Real, LbfgsMemory memory>
void LbfgsVectors<Real, memory>::combine(int begin, int end, const Outcome& outcome,
                                         const Single* image, Real* trial) {
  const Outcome now = outcome;  // a copy, which no store can change
  const Real scale = narrowed(now.scale), accepted = now.accepted, continues = now.continues;
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
    // a lane that does not continue may hold any trial
    trial[i] = select(continues, entry.u + next_length * select(accepted, direction, s), entry.u);
  }
}

}  // namespace snapspace
