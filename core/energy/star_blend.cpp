// The blended energy of stars. Only this file instantiates its inner loops, for every pack.
#include "energy/star_blend.h"

#include <algorithm>

#include "material/shell_arap.h"
#include "memory/prefetch.h"

namespace snapspace {

StarBlend::StarBlend(const std::vector<const VertexStars*>& poses,
                     const std::vector<std::vector<double>>& offsets)
    : poses_(poses.size()),
      first_corner_(poses[0]->first_corner),
      corners_(poses[0]->corners),
      first_neighbour_(poses[0]->first_neighbour),
      neighbours_(poses[0]->neighbours) {
  const int stars = poses[0]->count();
  const std::size_t vertices = first_neighbour_.size() - 1;
  vertex_numbers_.reserve(poses_ * (kCouplings * vertices + neighbours_.size()));
  for (int vertex = 0; vertex < static_cast<int>(vertices); ++vertex)
    for (std::size_t k = 0; k < poses_; ++k) append_vertex(vertex, *poses[k], offsets[k].data());
  star_numbers_.reserve(poses_ * (kHeader * stars + kPerCorner * (corners_.size() - stars)));
  for (int star = 0; star < stars; ++star) {
    centers_.push_back(poses[0]->center(star));
    for (std::size_t k = 0; k < poses_; ++k) append_star(star, *poses[k], offsets[k].data());
  }
}

int StarBlend::first_star(int vertex) const {
  return static_cast<int>(std::lower_bound(centers_.begin(), centers_.end(), vertex) -
                          centers_.begin());
}

void StarBlend::append_vertex(int vertex, const VertexStars& pose, const double* offset) {
  const double* const own = offset + 3 * static_cast<std::size_t>(vertex);
  const std::size_t begin = vertex_numbers_.size();
  vertex_numbers_.resize(begin + numbers_of_vertex(vertex));
  double* const numbers = vertex_numbers_.data() + begin;
  std::copy_n(own, 3, numbers + kOffset);
  double* coupling = numbers + kCouplings;
  for (int k = first_neighbour_[vertex]; k < first_neighbour_[vertex + 1]; ++k, ++coupling) {
    *coupling = pose.couplings[k];
    for (int r = 0; r < 3; ++r)
      numbers[kPull + r] +=
          (offset[3 * static_cast<std::size_t>(neighbours_[k]) + r] - own[r]) * *coupling;
  }
}

void StarBlend::append_star(int star, const VertexStars& pose, const double* offset) {
  const double* const own = offset + 3 * static_cast<std::size_t>(pose.center(star));
  const std::size_t begin = star_numbers_.size();
  star_numbers_.resize(begin + numbers_of_star(star));
  double* const header = star_numbers_.data() + begin;
  std::copy_n(&pose.frames[9 * static_cast<std::size_t>(star)], 9, header + kFrame);
  std::copy_n(header + kFrame, 9, header + kMap);
  header[kWeight] = pose.weights[star];
  double* next = header + kHeader;
  for (int c = first_corner_[star] + 1; c < first_corner_[star + 1]; ++c, next += kPerCorner) {
    std::copy_n(&pose.gradients[3 * static_cast<std::size_t>(c)], 3, next);
    for (int r = 0; r < 3; ++r) {
      const double edge = offset[3 * static_cast<std::size_t>(corners_[c]) + r] - own[r];
      for (int s = 0; s < 3; ++s) header[kMap + 3 * r + s] += edge * next[s];
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
    center_ = static_cast<std::size_t>(blend.centers_[star]);
    count_ = blend.ring(star);
    corners_ = blend.corners_.data() + blend.first_corner_[star] + 1;
    stride_ = blend.numbers_of_star(star);
    first_ = blend.begin_of_star(star);
    ahead_ = 2 * blend.poses_ * stride_;
    const Real* const own = u + 3 * center_;
    edges_.resize(3 * static_cast<std::size_t>(count_));
    forces_.assign(edges_.size(), Real(T(0)));
    for (int j = 0; j < count_; ++j)
      for (int r = 0; r < 3; ++r)
        edges_[3 * j + r] = u[3 * static_cast<std::size_t>(corners_[j]) + r] - own[r];
    sum_ = Real(T(0));
  }

  /// F L^T - I of the star in a pose; F is kept until `add`.
  void find_change(int pose, Real change[3][3]) {
    numbers_ = first_ + stride_ * static_cast<std::size_t>(pose);
    // the same pose two stars further on: hardware does not see that this is one stream
    prefetch(numbers_ + ahead_, stride_);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) map_[r][c] = Real(numbers_[kMap + 3 * r + c]);
    const double* next = numbers_ + kHeader;
    for (int j = 0; j < count_; ++j, next += kPerCorner)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) map_[r][c] += edges_[3 * j + r] * Real(next[c]);
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
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        Real moved = rounded(W[r][0] * Real(L[c]));
        for (int s = 1; s < 3; ++s) moved += W[r][s] * Real(L[3 * s + c]);
        const Real change = map_[r][c] - Real(L[3 * r + c]);
        stress[r][c] = weight * moved;
        sum_ += stress[r][c] * (moved - change - change);
        stress[r][c] += stress[r][c];
      }
    const double* next = numbers_ + kHeader;
    for (int j = 0; j < count_; ++j, next += kPerCorner)
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) forces_[3 * j + r] += stress[r][c] * Real(next[c]);
  }

  /// Adds the gradient of all poses, and returns their energy.
  Real finish(Real* gradient) {
    Real total[3] = {Real(T(0)), Real(T(0)), Real(T(0))};
    for (int j = 0; j < count_; ++j)
      for (int r = 0; r < 3; ++r) {
        gradient[3 * static_cast<std::size_t>(corners_[j]) + r] -= forces_[3 * j + r];
        total[r] += forces_[3 * j + r];
      }
    for (int r = 0; r < 3; ++r) gradient[3 * center_ + r] += total[r];
    return sum_;
  }

 private:
  std::size_t center_ = 0;
  int count_ = 0;
  const std::int32_t* corners_ = nullptr;  // besides the center
  const double *first_ = nullptr, *numbers_ = nullptr;
  std::size_t stride_ = 0, ahead_ = 0;
  std::vector<Real> edges_, forces_;
  Real sum_, map_[3][3];
};

template <class Real>
Real StarBlend::add_vertices(const Real* weights, const std::vector<int>& used, int begin, int end,
                             const Real* u, Real* gradient) const {
  using T = typename ScalarOf<Real>::type;
  Real energy(T(0));
  for (int vertex = begin; vertex < end; ++vertex) {
    const std::size_t own = 3 * static_cast<std::size_t>(vertex);
    const std::size_t stride = numbers_of_vertex(vertex);
    const double* const first = begin_of_vertex(vertex);
    const std::int32_t* const ring = neighbours_.data() + first_neighbour_[vertex];
    const int count = first_neighbour_[vertex + 1] - first_neighbour_[vertex];
    for (const int k : used) {
      const double* const numbers = first + stride * static_cast<std::size_t>(k);
      Real pull[3];
      for (int r = 0; r < 3; ++r) pull[r] = Real(numbers[kPull + r]);
      for (int j = 0; j < count; ++j) {
        const Real coupling(numbers[kCouplings + j]);
        const Real* const other = u + 3 * static_cast<std::size_t>(ring[j]);
        for (int r = 0; r < 3; ++r) pull[r] += (other[r] - u[own + r]) * coupling;
      }
      for (int r = 0; r < 3; ++r) {
        const Real weighted = weights[k] * pull[r];
        energy += (u[own + r] + Real(numbers[kOffset + r])) * weighted;
        gradient[own + r] += weighted + weighted;
      }
    }
  }
  return energy;
}

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
  Sum<Real> energy = widened(add_vertices(weights, used, begin, end, u, gradient));
  const int last = first_star(end);
  int star = first_star(begin);
  for (; star + 1 < last; star += 2) {
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
  if (star == last) return energy;
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
