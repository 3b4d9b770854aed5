// The blended energy of stars. Only this file instantiates its inner loops, for every pack.
#include "energy/star_blend.h"

#include <algorithm>

#include "material/shell_arap.h"
#include "memory/prefetch.h"

namespace snapspace {

StarBlend::StarBlend(const std::vector<const VertexStars*>& poses,
                     const std::vector<std::vector<double>>& offsets)
    : poses_(poses.size()), first_corner_(poses[0]->first_corner), corners_(poses[0]->corners) {
  const int count = poses[0]->count();
  const std::size_t vertices = first_corner_.size() - 1;
  numbers_.reserve(poses_ * (kHeader * vertices + kPerCorner * (corners_.size() - vertices)));
  for (int star = 0; star < count; ++star)
    for (std::size_t k = 0; k < poses_; ++k) {
      const VertexStars& pose = *poses[k];
      const double* const offset = offsets[k].data();
      const double* const own = offset + 3 * static_cast<std::size_t>(star);
      const std::size_t begin = numbers_.size();
      numbers_.resize(begin + numbers_of(star));
      double* const header = numbers_.data() + begin;
      std::copy_n(&pose.frames[9 * static_cast<std::size_t>(star)], 9, header + kFrame);
      std::copy_n(header + kFrame, 9, header + kMap);
      std::copy_n(own, 3, header + kOffset);
      header[kWeight] = pose.weights[star];
      double* next = header + kHeader;
      for (int c = first_corner_[star] + 1; c < first_corner_[star + 1]; ++c, next += kPerCorner) {
        std::copy_n(&pose.gradients[3 * static_cast<std::size_t>(c)], 3, next);
        next[3] = pose.couplings[c];
        for (int r = 0; r < 3; ++r) {
          const double edge = offset[3 * static_cast<std::size_t>(corners_[c]) + r] - own[r];
          for (int s = 0; s < 3; ++s) header[kMap + 3 * r + s] += edge * next[s];
          header[kPull + r] += edge * next[3];  // the couplings of a star sum to zero
        }
      }
    }
}

/// The sum over the poses for one star: u and `gradient` are those of all vertices.
template <class Real>
class StarBlend::StarSum {
 public:
  using T = typename ScalarOf<Real>::type;

  /// Begins with a star.
  void begin(const StarBlend& blend, int star, const Real* u) {
    star_ = star;
    count_ = blend.ring(star);
    corners_ = blend.corners_.data() + blend.first_corner_[star] + 1;
    stride_ = blend.numbers_of(star);
    first_ = blend.begin_of(star);
    ahead_ = 2 * blend.poses_ * stride_;
    own_ = u + 3 * static_cast<std::size_t>(star);
    edges_.resize(3 * static_cast<std::size_t>(count_));
    forces_.assign(edges_.size(), Real(T(0)));
    for (int j = 0; j < count_; ++j)
      for (int r = 0; r < 3; ++r)
        edges_[3 * j + r] = u[3 * static_cast<std::size_t>(corners_[j]) + r] - own_[r];
    for (Real& total : total_) total = Real(T(0));
    sum_ = Real(T(0));
  }

  /// F L^T - I of the star in a pose; kept until `add`: F and the pull on its vertex.
  void find_change(int pose, Real change[3][3]) {
    numbers_ = first_ + stride_ * static_cast<std::size_t>(pose);
    // the same pose two stars further on: hardware does not see that this is one stream
    prefetch(numbers_ + ahead_, stride_);
    for (int r = 0; r < 3; ++r) {
      pull_[r] = Real(numbers_[kPull + r]);
      for (int c = 0; c < 3; ++c) map_[r][c] = Real(numbers_[kMap + 3 * r + c]);
    }
    const double* next = numbers_ + kHeader;
    for (int j = 0; j < count_; ++j, next += kPerCorner)
      for (int r = 0; r < 3; ++r) {
        const Real edge = edges_[3 * j + r];
        for (int c = 0; c < 3; ++c) map_[r][c] += edge * Real(next[c]);
        pull_[r] += edge * Real(next[3]);
      }
    const double* const L = numbers_ + kFrame;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        Real product = rounded(map_[r][0] * Real(L[3 * c]));
        for (int s = 1; s < 3; ++s) product += map_[r][s] * Real(L[3 * c + s]);
        change[r][c] = r == c ? product - Real(T(1)) : product;
      }
  }

  /// Adds the pose with W = R - I.
  void add(const Real& pose_weight, const Real W[3][3]) {
    const double* const L = numbers_ + kFrame;
    const Real weight = pose_weight * Real(numbers_[kWeight]);
    Real stress[3][3];
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        Real moved = rounded(W[r][0] * Real(L[c]));
        for (int s = 1; s < 3; ++s) moved += W[r][s] * Real(L[3 * s + c]);
        const Real change = map_[r][c] - Real(L[3 * r + c]);
        stress[r][c] = weight * moved;
        sum_ += stress[r][c] * (moved - change - change);
        stress[r][c] += stress[r][c];
      }
      const Real pull = pose_weight * pull_[r];
      sum_ += (own_[r] + Real(numbers_[kOffset + r])) * pull;
      total_[r] += pull + pull;
    }
    const double* next = numbers_ + kHeader;
    for (int j = 0; j < count_; ++j, next += kPerCorner)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) forces_[3 * j + r] += stress[r][c] * Real(next[c]);
  }

  /// Adds the gradient of all poses, and returns their energy.
  Real finish(Real* gradient) {
    for (int j = 0; j < count_; ++j)
      for (int r = 0; r < 3; ++r) {
        gradient[3 * static_cast<std::size_t>(corners_[j]) + r] -= forces_[3 * j + r];
        total_[r] += forces_[3 * j + r];
      }
    for (int r = 0; r < 3; ++r) gradient[3 * static_cast<std::size_t>(star_) + r] += total_[r];
    return sum_;
  }

 private:
  int star_ = 0, count_ = 0;
  const std::int32_t* corners_ = nullptr;  // besides the vertex
  const double *first_ = nullptr, *numbers_ = nullptr;
  std::size_t stride_ = 0, ahead_ = 0;
  const Real* own_ = nullptr;  // of the vertex
  std::vector<Real> edges_, forces_;
  Real total_[3], sum_, map_[3][3], pull_[3];
};

namespace {

/// Turns two stars at once: the latency of one's divisions hides behind the other's.
template <class T, int Width>
void turn_both(const Pack<T, Width> first[3][3], const Pack<T, Width> second[3][3],
               Pack<T, Width> first_turn[3][3], Pack<T, Width> second_turn[3][3]) {
  Pack<T, 2 * Width> change[3][3], turn[3][3];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) change[r][c] = joined(first[r][c], second[r][c]);
  turn_of(change, turn);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) {
      first_turn[r][c] = half<false>(turn[r][c]);
      second_turn[r][c] = half<true>(turn[r][c]);
    }
}

}  // namespace

template <class Real>
Sum<Real> StarBlend::add_value_and_gradient(const Real* weights, int begin, int end, const Real* u,
                                            Real* gradient) const {
  std::vector<int> used;  // poses that count in any lane
  for (int k = 0; k < static_cast<int>(poses_); ++k)
    for (int lane = 0; lane < Real::kWidth; ++lane)
      if (weights[k][lane] != 0.0) {
        used.push_back(k);
        break;
      }
  StarSum<Real> one, other;
  Real change[3][3], other_change[3][3], turn[3][3], other_turn[3][3];
  Sum<Real> energy(0.0);
  int star = begin;
  for (; star + 1 < end; star += 2) {
    one.begin(*this, star, u);
    other.begin(*this, star + 1, u);
    for (const int k : used) {
      one.find_change(k, change);
      other.find_change(k, other_change);
      turn_both(change, other_change, turn, other_turn);
      one.add(weights[k], turn);
      other.add(weights[k], other_turn);
    }
    energy += widened(one.finish(gradient));
    energy += widened(other.finish(gradient));
  }
  if (star == end) return energy;
  one.begin(*this, star, u);
  for (const int k : used) {
    one.find_change(k, change);
    turn_of(change, turn);
    one.add(weights[k], turn);
  }
  energy += widened(one.finish(gradient));
  return energy;
}

#define SNAPSPACE_DEFINED(Real)                                                                   \
  template Sum<Real> StarBlend::add_value_and_gradient(const Real*, int, int, const Real*, Real*) \
      const;
SNAPSPACE_DOUBLE_LANE_PACKS(SNAPSPACE_DEFINED)
#undef SNAPSPACE_DEFINED

}  // namespace snapspace
