#pragma once
/// L-BFGS in lockstep over the lanes, seeded with a fixed inverse (Nocedal & Wright 2006, alg. 7.4;
/// the seed as in Liu, Bouaziz, Kavan 2017).
/// Each lockstep evaluates all lanes once, each at its own trial step. A lane whose step is
/// accepted gets a new direction; a lane whose step is refused gets a shorter step; a finished lane
/// takes the next sample. Lanes never exchange anything, so the result of a sample does not depend
/// on its lane or on the samples beside it.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"
#include "snapshots/lane.h"
#include "snapshots/lane_objectives.h"
#include "snapshots/lane_seed.h"
#include "snapshots/lbfgs_vectors.h"
#include "snapshots/sample_exchange.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// @tparam Real  a pack, in the precision of shapes and gradients; values and inner products are
///               always in double precision
template <LbfgsMemory memory, class Real>
class LaneLbfgs {
 public:
  static constexpr int kWidth = Real::kWidth;

  /// @param threads  those that the objective may use
  LaneLbfgs(const LaneObjectives& objectives, const SolveOptions& options,
            const ThreadShare& threads)
      : objectives_(objectives),
        options_(options),
        threads_(threads),
        objective_(objectives.objective<Real>(threads)),
        size_(objective_->size()),
        vectors_(objectives.masses()),
        trial_(size_, Real(0)),
        gradient_(size_, Real(0)),
        work_(kIsSingle ? 0 : size_, 0.0f) {}

  /// Solves samples until there are no more.
  void run(SampleExchange& exchange, const SolveControl& control) {
    while (const int busy = fill(exchange)) {
      if constexpr (kWidth > 2)
        if (2 * busy <= kWidth && exchange.exhausted()) {
          apply();
          Half(*this).run(exchange, control);
          return;
        }
      if (!step(control)) return;
      for (int lane = 0; lane < kWidth; ++lane) {
        if (!lanes_[lane].busy()) continue;
        if (lanes_[lane].done)
          hand_over(lane, exchange);
        else
          exchange.report_evaluations(lanes_[lane].id(), lanes_[lane].evaluations);
      }
    }
  }

 private:
  template <LbfgsMemory, class>
  friend class LaneLbfgs;
  /// Half as wide: when half of the lanes would be empty. Results are bitwise the same.
  using Half = LaneLbfgs<memory, Pack<typename Real::Scalar, std::max(2, kWidth / 2)>>;

  static constexpr int kPairs = memory.pairs;
  using Total = Lanes<kWidth>;
  using Single = SingleLanes<kWidth>;
  static constexpr bool kIsSingle = std::is_same_v<Single, Real>;
  /// Relative error of a value, which is a sum of many terms with the rounding of the precision.
  static constexpr double kRounding = kIsSingle ? 1e-7 : 1e-12;
  using Pairs = PairProducts<memory>;
  using Vectors = LbfgsVectors<Real, memory>;
  using Products = typename Vectors::Products;
  using Outcome = typename Vectors::Outcome;
  using TrialOutcome = Lane::TrialOutcome;

  /// Takes over the samples of a wider pack that holds at most kWidth of them.
  template <class Wide>
  explicit LaneLbfgs(Wide& from) : LaneLbfgs(from.objectives_, from.options_, from.threads_) {
    std::vector<int> lanes;
    for (int lane = 0; lane < Wide::kWidth; ++lane)
      if (from.lanes_[lane].busy()) lanes.push_back(lane);
    vectors_.take_lanes(from.vectors_, lanes);
    for (int lane = 0; lane < static_cast<int>(lanes.size()); ++lane) {
      const int source_lane = lanes[lane];
      lanes_[lane] = std::exchange(from.lanes_[source_lane], {});
      steps_.set(lane, from.steps_[source_lane]);
      objective_->load(lane, lanes_[lane].sample->input.data());
      objective_->load_seed(lane, lanes_[lane].seed);
      pairs_[lane] = from.pairs_[source_lane];
      for (int i = 0; i < size_; ++i) trial_[i].set(lane, from.trial_[i][source_lane]);
    }
  }

  /// Gives samples to the empty lanes. Returns how many lanes are then busy.
  int fill(SampleExchange& exchange) {
    int busy = static_cast<int>(
        std::count_if(lanes_, lanes_ + kWidth, [](const Lane& lane) { return lane.busy(); }));
    for (int lane = 0; lane < kWidth && busy < kWidth; ++lane) {
      if (lanes_[lane].busy()) continue;
      std::optional<Sample> sample = exchange.take(busy);
      if (!sample) break;
      load(lane, std::move(*sample));
      ++busy;
    }
    return busy;
  }

  /// Entry i of a lane's current point, even if the vectors are not updated yet.
  [[nodiscard]] double at(int lane, int i) const {
    return trial_outcomes_[lane] == TrialOutcome::refused ? vectors_.at(lane, i) : trial_[i][lane];
  }

  void hand_over(int lane, SampleExchange& exchange) {
    std::vector<double>& shape = lanes_[lane].sample->start;  // no longer needed
    for (int i = 0; i < size_; ++i) shape[i] = at(lane, i);
    exchange.finish(lanes_[lane].id(), lanes_[lane].report(), std::move(shape));
    lanes_[lane].sample.reset();
  }

  /// The vectors keep the data of the lane's last sample: a fresh lane steps by zero, and its
  /// memory has no weight. All of these data are finite.
  void load(int index, Sample sample) {
    Lane& lane = lanes_[index] = Lane::expecting(objective_->negligible());
    lane.fresh = true;
    lane.begin = std::chrono::steady_clock::now();
    trial_outcomes_[index] = TrialOutcome::refused;
    pairs_[index].forget();
    objective_->load(index, sample.input.data());
    for (int i = 0; i < size_; ++i) {
      vectors_.place(index, i, sample.start[i]);
      if (!pending_) set_lane(trial_[i], index, sample.start[i]);  // otherwise the next pass does
    }
    lane.sample = std::move(sample);
    set_seed(*objective_, index, lane, lane.sample->start);
  }

  /// Evaluates all lanes once and acts on the results. Returns false if the control cancels; it
  /// is checked between the parts, which take a while on large meshes.
  bool step(const SolveControl& control) {
    if (control.cancelled) return false;
    Pass pass(*this);
    const Total value = objective_->value_and_gradient(trial_.data(), gradient_.data(), pass);
    const Products& products = pass.products;
    if (control.cancelled) return false;
    const Total image_products = objective_->precondition(single_gradient(), single_gradient());
    if (control.cancelled) return false;
    for (int lane = 0; lane < kWidth; ++lane) {
      trial_outcomes_[lane] =
          lanes_[lane].judge(value[lane], slope(lane, products), products.step_square[lane],
                             products.trial_square[lane], kRounding);
      if (trial_outcomes_[lane] == TrialOutcome::refused) continue;
      lanes_[lane].accept_norm(std::sqrt(products.gradient_square[lane]));
    }
    scale_ = pass.scale;
    choose_directions(products, scale_ * scale_ * image_products);
    pending_ = true;
    return true;
  }

  /// A step's work on the vectors during the objective's pass: first the update that the last step
  /// decided on, and then, when a gradient is complete, its products.
  struct Pass final : SweepVisitor {
    LaneLbfgs& solver;
    Outcome outcome;
    Products products;
    Total scale, shrink;

    explicit Pass(LaneLbfgs& lbfgs) : solver(lbfgs) {
      for (int lane = 0; lane < kWidth; ++lane) {
        scale.set(lane, solver.lanes_[lane].scale);
        shrink.set(lane, 1.0 / solver.lanes_[lane].scale);
      }
      if (!solver.pending_) return;
      outcome = solver.make_outcome();
    }
    void before(int begin, int end) override {
      if (solver.pending_)
        solver.vectors_.combine(begin, end, outcome, solver.single_gradient(),
                                solver.trial_.data());
    }
    void after(int begin, int end) override {
      solver.vectors_.add_products(begin, end, solver.trial_.data(), solver.gradient_.data(),
                                   shrink, solver.single_gradient(), products);
    }
  };

  /// Does now the update that the next step would begin with.
  void apply() {
    Pass(*this).before(0, vectors_.vertices());
    pending_ = false;
  }

  /// Where A^-1 is applied to the gradient: in place, if the gradient is in single precision.
  Single* single_gradient() {
    if constexpr (kIsSingle)
      return gradient_.data();
    else
      return work_.data();
  }

  /// Gradient at a trial . direction that led there; after a step below rounding, the old slope.
  [[nodiscard]] double slope(int lane, const Products& products) const {
    const bool no_step = products.step_square[lane] == 0.0;
    return no_step ? lanes_[lane].slope : products.newest[lane] / steps_[lane];
  }

  /// Chooses new directions for the lanes that accept their trial, or finishes their samples.
  /// @param image_products  gradient . A^-1 gradient
  void choose_directions(const Products& products, Total image_products) {
    for (int lane = 0; lane < kWidth; ++lane) {
      if (trial_outcomes_[lane] == TrialOutcome::refused) continue;
      typename Pairs::Trial trial{slope(lane, products), {}, {}, image_products[lane]};
      for (int k = 0; k < kPairs; ++k) trial.images[k] = products.images[k][lane];
      for (int k = 0; k < kPairs - 1; ++k) trial.steps[k] = products.steps[k][lane];
      if (trial_outcomes_[lane] == TrialOutcome::moved)
        pairs_[lane].move(trial, steps_[lane]);
      else
        pairs_[lane].start(trial);
      const double slope = pairs_[lane].choose_direction();
      if (!std::isfinite(slope)) {  // nothing of this trial may enter the vectors
        trial_outcomes_[lane] = TrialOutcome::refused;
        lanes_[lane].finish(SolveStatus::not_finite);
        pairs_[lane].forget();
        continue;
      }
      test_convergence(lane, slope);
    }
  }

  /// The update of the vectors and the next trials that follow from the lanes' last trials.
  Outcome make_outcome() {
    Outcome outcome;
    outcome.scale = scale_;
    for (int lane = 0; lane < kWidth; ++lane) {
      outcome.accepted.set(lane, trial_outcomes_[lane] != TrialOutcome::refused ? 1 : 0);
      outcome.set_weights(lane, pairs_[lane]);
      const bool continues = lanes_[lane].running() && !lanes_[lane].fresh;
      outcome.continues.set(lane, continues);
      const double before = trial_outcomes_[lane] == TrialOutcome::refused ? steps_[lane] : 1.0;
      steps_.set(lane, continues ? lanes_[lane].step : 0.0);
      if (continues) outcome.next_length.set(lane, steps_[lane] / before);
    }
    return outcome;
  }

  void test_convergence(int index, double slope) {
    Lane& lane = lanes_[index];
    lane.slope = slope;
    if (slope > 0.0) return restart(index);
    if (lane.converged(options_.tolerance, objective_->negligible()) ||
        lane.settled(options_.settling))
      return lane.finish(SolveStatus::converged);
    if (kIsSingle && lane.stalled(kRounding)) return lane.finish(SolveStatus::line_search_failed);
    if (lane.iterations >= options_.max_iterations) lane.finish(SolveStatus::max_iterations);
    if (!lane.done && lane.needs_seed()) renew_seed(index);
  }

  /// Continues with a seed made at a lane's trial. The memory belongs to the old seed.
  void renew_seed(int index) {
    set_seed(*objective_, index, lanes_[index], lane_of(trial_, index));
    pairs_[index].forget();
    lanes_[index].fresh = true;
  }

  /// Rounding gave an ascent direction: forgets the memory. The second time, the gradient is noise.
  void restart(int index) {
    if (lanes_[index].restarted) return lanes_[index].finish(SolveStatus::line_search_failed);
    lanes_[index].restarted = true;
    pairs_[index].forget();
    lanes_[index].fresh = true;
  }

  const LaneObjectives& objectives_;
  SolveOptions options_;
  const ThreadShare& threads_;
  std::unique_ptr<LaneObjective<Real>> objective_;
  int size_;
  Vectors vectors_;
  Pairs pairs_[kWidth];
  Lane lanes_[kWidth];
  TrialOutcome trial_outcomes_[kWidth];  // outcomes of the last trials
  bool pending_ = false;  // whether the vectors still need the update for these outcomes
  Total scale_ = 1.0;     // A^-1 gradient = scale_ * single_gradient() at the last trials
  Total steps_ = 0.0;     // to the trials, as shares of the directions
  StreamedVector<Real> trial_, gradient_;  // the trial points, and the gradients there
  StreamedVector<Single> work_;            // single_gradient() of gradients in double precision
};

}  // namespace snapspace
