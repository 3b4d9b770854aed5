#pragma once
#include <cmath>
#include <vector>

#include "simd/lanes.h"

namespace snapspace {

/// The memory of L-BFGS for all lanes, with the two-loop recursion (Nocedal & Wright, alg. 7.4).
///
/// The recursion is bound by the time it takes to read its pairs of vectors. So the pairs are kept
/// in single precision, which perturbs the approximation of the inverse Hessian by 1e-7 and the
/// result of the solve not at all; and the recursion runs on inner products that are known from
/// earlier (as in Chen, Wang, Zhou 2014), so that each of its passes combines or multiplies all
/// pairs at once.
///
/// Every lane has its own slots; an empty one has zero curvature. The ring's position is shared.
template <class Real>
class LbfgsMemory {
 public:
  static constexpr int kWidth = Real::kWidth;
  using Total = Lanes<kWidth>;
  using Single = SingleLanes<kWidth>;
  /// On 16 samples of the Dragon 2, 3, 5 and 8 pairs need 77, 76, 73 and 73 evaluations, while
  /// every pair adds to the cost of each.
  static constexpr int kPairs = 3;

  explicit LbfgsMemory(int size) : size_(size) {
    for (int k = 0; k < kPairs; ++k) {
      steps_[k].assign(size, 0.0f);
      changes_[k].assign(size, 0.0f);
    }
    for (int k = 0; k < kPairs; ++k) {
      curvature_[k] = step_gradient_[k] = change_direction_[k] = 0.0;
      for (int j = 0; j < kPairs; ++j) product_[k][j] = 0.0;
    }
  }

  /// Takes over everything from the lanes of a wider memory.
  template <class Wide>
  void take_lanes(const LbfgsMemory<Wide>& from, const std::vector<int>& lanes) {
    newest_ = from.newest_;
    for (int lane = 0; lane < static_cast<int>(lanes.size()); ++lane) {
      const int there = lanes[lane];
      for (int k = 0; k < kPairs; ++k) {
        curvature_[k].set(lane, from.curvature_[k][there]);
        step_gradient_[k].set(lane, from.step_gradient_[k][there]);
        change_direction_[k].set(lane, from.change_direction_[k][there]);
        for (int j = 0; j < kPairs; ++j) product_[k][j].set(lane, from.product_[k][j][there]);
        for (int i = 0; i < size_; ++i) {
          steps_[k][i].set(lane, from.steps_[k][i][there]);
          changes_[k][i].set(lane, from.changes_[k][i][there]);
        }
      }
    }
  }

  /// Empties a lane: its pairs stay where they are, but have no weight.
  void forget(int lane) {
    for (int k = 0; k < kPairs; ++k) {
      curvature_[k].set(lane, 0.0);
      step_gradient_[k].set(lane, 0.0);
      change_direction_[k].set(lane, 0.0);
      for (int j = 0; j < kPairs; ++j) product_[k][j].set(lane, 0.0);
    }
  }

  /// Also clears the pairs, which are not finite: no weight times a NaN would still be NaN.
  void clear(int lane) {
    forget(lane);
    for (int k = 0; k < kPairs; ++k)
      for (int i = 0; i < size_; ++i) {
        steps_[k][i].set(lane, 0.0f);
        changes_[k][i].set(lane, 0.0f);
      }
  }

  /// Moves the lanes of `accepted` from u to trial and from gradient to trial_gradient, and those
  /// of `remembered` among them put the pair of differences into the next slot; the others put an
  /// empty pair there, because what a lane remembers must not depend on its neighbours.
  /// @param length  step lengths: trial = u + length * direction
  void move(Real accepted, Real remembered, Total length, const Real* trial,
            const Real* trial_gradient, Real* u, Real* gradient);

  /// right_hand_side = (gradient - sum of the first loop) / |gradient|, in single precision.
  void first_loop(const Real* gradient, Single* right_hand_side);

  /// direction = -(preconditioned / scale + sum of the second loop) for the lanes of `accepted`;
  /// returns gradient . direction.
  Total second_loop(Real accepted, const Real* gradient, const Single* preconditioned,
                    Real* direction);

 private:
  template <class>
  friend class LbfgsMemory;

  /// In the precision of shapes.
  template <class T>
  static Real narrowed(Pack<T, kWidth> a) {
    return cast<typename Real::Scalar>(a);
  }
  int slot(int age) const { return (newest_ - age + kPairs) % kPairs; }

  int size_;
  int newest_ = 0;
  std::vector<Single> steps_[kPairs];    // s of the textbook
  std::vector<Single> changes_[kPairs];  // y
  Total curvature_[kPairs];              // 1 / s.y, zero where there is no pair
  Total product_[kPairs][kPairs];        // s_k . y_j
  Total step_gradient_[kPairs];          // s_k . gradient
  Total change_direction_[kPairs];       // y_k . direction
  Total first_[kPairs];                  // coefficients of the first loop
  Total scale_ = 1.0;                    // 1 / |gradient|
};

template <class Real>
void LbfgsMemory<Real>::move(Real accepted, Real remembered, Total length, const Real* trial,
                             const Real* trial_gradient, Real* u, Real* gradient) {
  newest_ = (newest_ + 1) % kPairs;
  const int p = newest_;
  Single* s = steps_[p].data();
  Single* y = changes_[p].data();
  Total sy(0.0), ss(0.0), yy(0.0), gg(0.0);
  Total sg[kPairs];
  for (Total& sum : sg) sum = 0.0;
  const Real zero(0);
  for (int i = 0; i < size_; ++i) {
    const Real step = select(remembered, trial[i] - u[i], zero);
    const Real change = select(remembered, trial_gradient[i] - gradient[i], zero);
    u[i] = select(accepted, trial[i], u[i]);
    gradient[i] = select(accepted, trial_gradient[i], gradient[i]);
    const Total g = widened(gradient[i]);
    s[i] = cast<float>(step);
    y[i] = cast<float>(change);
    sy += widened(step) * widened(change);
    ss += widened(step) * widened(step);
    yy += widened(change) * widened(change);
    gg += g * g;
    for (int k = 0; k < kPairs; ++k) sg[k] += widened(steps_[k][i]) * g;
  }
  const Total kept = widened(remembered), none(0.0);
  for (int k = 0; k < kPairs; ++k) {
    // s_k . y_p is the change of s_k . gradient, and s_p . y_k a multiple of direction . y_k.
    product_[k][p] = select(kept, sg[k] - step_gradient_[k], none);
    product_[p][k] = select(kept, length * change_direction_[k], none);
    step_gradient_[k] = sg[k];
  }
  product_[p][p] = sy;
  for (int lane = 0; lane < kWidth; ++lane) {
    // Pairs of negative or vanishing curvature would make the inverse indefinite.
    const bool usable = sy[lane] > 1e-12 * std::sqrt(ss[lane] * yy[lane]);
    curvature_[p].set(lane, usable ? 1.0 / sy[lane] : 0.0);
    scale_.set(lane, gg[lane] > 0.0 ? 1.0 / std::sqrt(gg[lane]) : 1.0);
  }
}

template <class Real>
void LbfgsMemory<Real>::first_loop(const Real* gradient, Single* right_hand_side) {
  for (int age = 0; age < kPairs; ++age) {
    const int k = slot(age);
    Total sq = step_gradient_[k];
    for (int newer = 0; newer < age; ++newer) sq -= first_[slot(newer)] * product_[k][slot(newer)];
    first_[k] = curvature_[k] * sq;
  }
  const Single* y[kPairs];
  Real weight[kPairs];
  for (int age = 0; age < kPairs; ++age) {
    y[age] = changes_[slot(age)].data();
    weight[age] = narrowed(first_[slot(age)]);
  }
  const Real scale = narrowed(scale_);
  for (int i = 0; i < size_; ++i) {
    Real sum = gradient[i];
    for (int age = 0; age < kPairs; ++age) sum -= weight[age] * narrowed(y[age][i]);
    right_hand_side[i] = cast<float>(sum * scale);
  }
}

template <class Real>
auto LbfgsMemory<Real>::second_loop(Real accepted, const Real* gradient,
                                    const Single* preconditioned, Real* direction) -> Total {
  Total unscaled;
  for (int lane = 0; lane < kWidth; ++lane) unscaled.set(lane, 1.0 / scale_[lane]);
  Total yr[kPairs];
  for (Total& sum : yr) sum = 0.0;
  for (int i = 0; i < size_; ++i) {
    const Total r = widened(preconditioned[i]) * unscaled;
    for (int k = 0; k < kPairs; ++k) yr[k] += widened(changes_[k][i]) * r;
  }
  const Single* s[kPairs];
  Total weight[kPairs];
  Real weight_of_step[kPairs];
  for (int age = kPairs - 1; age >= 0; --age) {
    const int k = slot(age);
    s[age] = steps_[k].data();
    Total y_result = yr[k];
    for (int older = kPairs - 1; older > age; --older)
      y_result += weight[older] * product_[slot(older)][k];
    weight[age] = first_[k] - curvature_[k] * y_result;
    weight_of_step[age] = narrowed(weight[age]);
  }
  const Total moved = widened(accepted);
  for (int k = 0; k < kPairs; ++k) {
    Total y_result = yr[k];
    for (int age = 0; age < kPairs; ++age) y_result += weight[age] * product_[slot(age)][k];
    change_direction_[k] = select(moved, -y_result, change_direction_[k]);
  }
  const Real unscale = narrowed(unscaled);
  Total slope(0.0);
  for (int i = 0; i < size_; ++i) {
    Real result = narrowed(preconditioned[i]) * unscale;
    for (int age = 0; age < kPairs; ++age) result += weight_of_step[age] * narrowed(s[age][i]);
    direction[i] = select(accepted, -result, direction[i]);
    slope += widened(gradient[i]) * widened(direction[i]);
  }
  return slope;
}

}  // namespace snapspace
