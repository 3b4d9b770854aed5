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
template <int Width>
class LbfgsMemory {
 public:
  using Real = Lanes<Width>;
  using Single = SingleLanes<Width>;
  /// On ten samples of the Dragon 5, 6, 8 and 12 pairs need 172, 169, 174 and 159 evaluations,
  /// while every pair adds to the cost of each.
  static constexpr int kPairs = 5;

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

  /// Empties a lane. The pairs are cleared too: zero curvature times a NaN would stay NaN.
  void forget(int lane) {
    for (int k = 0; k < kPairs; ++k) {
      curvature_[k].set(lane, 0.0);
      step_gradient_[k].set(lane, 0.0);
      change_direction_[k].set(lane, 0.0);
      for (int j = 0; j < kPairs; ++j) product_[k][j].set(lane, 0.0);
      for (int i = 0; i < size_; ++i) {
        steps_[k][i].set(lane, 0.0f);
        changes_[k][i].set(lane, 0.0f);
      }
    }
  }

  /// Moves the lanes of `accepted` from u to trial and from gradient to trial_gradient, and those
  /// of `remembered` among them put the pair of differences into the next slot; the others put an
  /// empty pair there, because what a lane remembers must not depend on its neighbours.
  /// @param length  step lengths: trial = u + length * direction
  void move(Real accepted, Real remembered, Real length, const Real* trial,
            const Real* trial_gradient, Real* u, Real* gradient);

  /// right_hand_side = (gradient - sum of the first loop) / |gradient|, in single precision.
  void first_loop(const Real* gradient, Single* right_hand_side);

  /// direction = -(preconditioned / scale + sum of the second loop) for the lanes of `accepted`;
  /// returns gradient . direction.
  Real second_loop(Real accepted, const Real* gradient, const Single* preconditioned,
                   Real* direction);

 private:
  int slot(int age) const { return (newest_ - age + kPairs) % kPairs; }

  int size_;
  int newest_ = 0;
  std::vector<Single> steps_[kPairs];    // s of the textbook
  std::vector<Single> changes_[kPairs];  // y
  Real curvature_[kPairs];               // 1 / s.y, zero where there is no pair
  Real product_[kPairs][kPairs];         // s_k . y_j
  Real step_gradient_[kPairs];           // s_k . gradient
  Real change_direction_[kPairs];        // y_k . direction
  Real first_[kPairs];                   // coefficients of the first loop
  Real scale_ = 1.0;                     // 1 / |gradient|
};

template <int Width>
void LbfgsMemory<Width>::move(Real accepted, Real remembered, Real length, const Real* trial,
                              const Real* trial_gradient, Real* u, Real* gradient) {
  newest_ = (newest_ + 1) % kPairs;
  const int p = newest_;
  Single* s = steps_[p].data();
  Single* y = changes_[p].data();
  Real sy(0.0), ss(0.0), yy(0.0), gg(0.0);
  Real sg[kPairs];
  for (Real& sum : sg) sum = 0.0;
  const Real zero(0.0);
  for (int i = 0; i < size_; ++i) {
    const Real step = select(remembered, trial[i] - u[i], zero);
    const Real change = select(remembered, trial_gradient[i] - gradient[i], zero);
    u[i] = select(accepted, trial[i], u[i]);
    const Real g = gradient[i] = select(accepted, trial_gradient[i], gradient[i]);
    s[i] = to_single(step);
    y[i] = to_single(change);
    sy += step * change;
    ss += step * step;
    yy += change * change;
    gg += g * g;
    for (int k = 0; k < kPairs; ++k) sg[k] += to_double(steps_[k][i]) * g;
  }
  for (int k = 0; k < kPairs; ++k) {
    // s_k . y_p is the change of s_k . gradient, and s_p . y_k a multiple of direction . y_k.
    product_[k][p] = select(remembered, sg[k] - step_gradient_[k], zero);
    product_[p][k] = select(remembered, length * change_direction_[k], zero);
    step_gradient_[k] = sg[k];
  }
  product_[p][p] = sy;
  for (int lane = 0; lane < Width; ++lane) {
    // Pairs of negative or vanishing curvature would make the inverse indefinite.
    const bool usable = sy[lane] > 1e-12 * std::sqrt(ss[lane] * yy[lane]);
    curvature_[p].set(lane, usable ? 1.0 / sy[lane] : 0.0);
    scale_.set(lane, gg[lane] > 0.0 ? 1.0 / std::sqrt(gg[lane]) : 1.0);
  }
}

template <int Width>
void LbfgsMemory<Width>::first_loop(const Real* gradient, Single* right_hand_side) {
  for (int age = 0; age < kPairs; ++age) {
    const int k = slot(age);
    Real sq = step_gradient_[k];
    for (int newer = 0; newer < age; ++newer) sq -= first_[slot(newer)] * product_[k][slot(newer)];
    first_[k] = curvature_[k] * sq;
  }
  const Single* y[kPairs];
  Real weight[kPairs];
  for (int age = 0; age < kPairs; ++age) {
    y[age] = changes_[slot(age)].data();
    weight[age] = first_[slot(age)];
  }
  for (int i = 0; i < size_; ++i) {
    Real sum = gradient[i];
    for (int age = 0; age < kPairs; ++age) sum -= weight[age] * to_double(y[age][i]);
    right_hand_side[i] = to_single(sum * scale_);
  }
}

template <int Width>
Lanes<Width> LbfgsMemory<Width>::second_loop(Real accepted, const Real* gradient,
                                             const Single* preconditioned, Real* direction) {
  Real unscale;
  for (int lane = 0; lane < Width; ++lane) unscale.set(lane, 1.0 / scale_[lane]);
  Real yr[kPairs];
  for (Real& sum : yr) sum = 0.0;
  for (int i = 0; i < size_; ++i) {
    const Real r = to_double(preconditioned[i]) * unscale;
    for (int k = 0; k < kPairs; ++k) yr[k] += to_double(changes_[k][i]) * r;
  }
  const Single* s[kPairs];
  Real weight[kPairs];
  for (int age = kPairs - 1; age >= 0; --age) {
    const int k = slot(age);
    s[age] = steps_[k].data();
    Real y_result = yr[k];
    for (int older = kPairs - 1; older > age; --older)
      y_result += weight[older] * product_[slot(older)][k];
    weight[age] = first_[k] - curvature_[k] * y_result;
  }
  for (int k = 0; k < kPairs; ++k) {
    Real y_result = yr[k];
    for (int age = 0; age < kPairs; ++age) y_result += weight[age] * product_[slot(age)][k];
    change_direction_[k] = select(accepted, -y_result, change_direction_[k]);
  }
  Real slope(0.0);
  for (int i = 0; i < size_; ++i) {
    Real result = to_double(preconditioned[i]) * unscale;
    for (int age = 0; age < kPairs; ++age) result += weight[age] * to_double(s[age][i]);
    direction[i] = select(accepted, -result, direction[i]);
    slope += gradient[i] * direction[i];
  }
  return slope;
}

}  // namespace snapspace
