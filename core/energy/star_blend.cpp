// The blended energy of stars. Only this file instantiates its inner loops, for every pack.
#include "energy/star_blend.h"

#include <algorithm>

#include "material/shell_arap.h"

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
    append_star(star, poses, offsets);
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

void StarBlend::append_star(int star, const std::vector<const VertexStars*>& poses,
                            const std::vector<std::vector<double>>& offsets) {
  const int first = first_corner_[star] + 1, last = first_corner_[star + 1];
  for (std::size_t k = 0; k < poses_; ++k) {
    const VertexStars& pose = *poses[k];
    const double* const own = offsets[k].data() + 3 * static_cast<std::size_t>(pose.center(star));
    double header[kHeader];
    std::copy_n(&pose.frames[9 * static_cast<std::size_t>(star)], 9, header + kFrame);
    std::copy_n(header + kFrame, 9, header + kMap);
    header[kWeight] = pose.weights[star];
    for (int c = first; c < last; ++c)
      for (int r = 0; r < 3; ++r) {
        const double edge = offsets[k][3 * static_cast<std::size_t>(corners_[c]) + r] - own[r];
        for (int s = 0; s < 3; ++s)
          header[kMap + 3 * r + s] += edge * pose.gradients[3 * static_cast<std::size_t>(c) + s];
      }
    star_numbers_.insert(star_numbers_.end(), header, header + kHeader);
  }
  for (int begin = first; begin < last; begin += kTile) {
    const auto count = static_cast<std::size_t>(std::min(last - begin, int{kTile}));
    for (const VertexStars* const pose : poses) {
      const double* const shares = &pose->gradients[3 * static_cast<std::size_t>(begin)];
      star_numbers_.insert(star_numbers_.end(), shares, shares + kPerCorner * count);
    }
  }
}

/// The sum over the poses for one star: u and `gradient` are those of all vertices.
///
/// Large stars have more corners than fit into the fastest memory for all lanes. So their corners
/// are visited in tiles, each for all poses, first for the maps F and then for the forces.
template <class Real>
class StarBlend::StarSum {
 public:
  using T = typename ScalarOf<Real>::type;

  /// Finds the maps F of a star in some poses.
  void find_maps(const StarBlend& blend, int star, const std::vector<int>& poses, const Real* u) {
    center_ = static_cast<std::size_t>(blend.centers_[star]);
    count_ = blend.ring(star);
    corners_ = blend.corners_.data() + blend.first_corner_[star] + 1;
    headers_ = blend.begin_of_star(star);
    shares_ = headers_ + kHeader * blend.poses_;
    all_poses_ = static_cast<int>(blend.poses_);
    sum_ = Real(T(0));
    maps_.resize(9 * poses.size());
    Real* map = maps_.data();
    for (const int pose : poses)
      for (int e = 0; e < 9; ++e) *map++ = Real(header(pose)[kMap + e]);
    for (int begin = 0; begin < count_; begin += kTile) add_tile_to_maps(begin, poses, u);
  }

  /// F L^T - I of the i-th of these poses.
  void find_change(int i, int pose, Real change[3][3]) const {
    const Real* const map = maps_.data() + 9 * i;
    const double* const L = header(pose) + kFrame;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        Real product = rounded(map[3 * r] * Real(L[3 * c]));
        for (int s = 1; s < 3; ++s) product += map[3 * r + s] * Real(L[3 * c + s]);
        change[r][c] = r == c ? product - Real(T(1)) : product;
      }
  }

  /// Adds the i-th of these poses with W = R - I. Its stress replaces its F.
  void turn(int i, int pose, const Real& pose_weight, const Real W[3][3]) {
    Real* const map = maps_.data() + 9 * i;
    const double* const L = header(pose) + kFrame;
    const Real weight = pose_weight * Real(header(pose)[kWeight]);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) {
        Real moved = rounded(W[r][0] * Real(L[c]));
        for (int s = 1; s < 3; ++s) moved += W[r][s] * Real(L[3 * s + c]);
        const Real change = map[3 * r + c] - Real(L[3 * r + c]);
        const Real stress = weight * moved;
        sum_ += stress * (moved - change - change);
        map[3 * r + c] = stress + stress;
      }
  }

  /// Adds the gradient of all these poses, and returns their energy.
  Real finish(const std::vector<int>& poses, Real* gradient) {
    Real total[3] = {Real(T(0)), Real(T(0)), Real(T(0))};
    for (int begin = 0; begin < count_; begin += kTile) {
      const int count = find_tile_of_forces(begin, poses);
      for (int j = 0; j < count; ++j)
        for (int r = 0; r < 3; ++r) {
          gradient[3 * static_cast<std::size_t>(corners_[begin + j]) + r] -= tile_[j][r];
          total[r] += tile_[j][r];
        }
    }
    for (int r = 0; r < 3; ++r) gradient[3 * center_ + r] += total[r];
    return sum_;
  }

 private:
  [[nodiscard]] const double* header(int pose) const { return headers_ + kHeader * pose; }
  [[nodiscard]] const double* shares(int pose, int begin, int count) const {
    return shares_ + kPerCorner * (all_poses_ * begin + pose * count);
  }
  [[nodiscard]] int tile_size(int begin) const { return std::min(count_ - begin, int{kTile}); }

  void add_tile_to_maps(int begin, const std::vector<int>& poses, const Real* u) {
    const int count = tile_size(begin);
    const Real* const own = u + 3 * center_;
    for (int j = 0; j < count; ++j)
      for (int r = 0; r < 3; ++r)
        tile_[j][r] = u[3 * static_cast<std::size_t>(corners_[begin + j]) + r] - own[r];
    Real* in_memory = maps_.data();
    for (const int pose : poses) {
      Real map[9];  // in registers
      for (int e = 0; e < 9; ++e) map[e] = in_memory[e];
      const double* next = shares(pose, begin, count);
      for (int j = 0; j < count; ++j, next += kPerCorner)
        for (int r = 0; r < 3; ++r)
          for (int c = 0; c < 3; ++c) map[3 * r + c] += tile_[j][r] * Real(next[c]);
      for (int e = 0; e < 9; ++e) *in_memory++ = map[e];
    }
  }

  /// Forces at the corners of a tile, and how many these are.
  int find_tile_of_forces(int begin, const std::vector<int>& poses) {
    const int count = tile_size(begin);
    for (int j = 0; j < count; ++j)
      for (int r = 0; r < 3; ++r) tile_[j][r] = Real(T(0));
    const Real* in_memory = maps_.data();
    for (const int pose : poses) {
      Real stress[9];
      for (int e = 0; e < 9; ++e) stress[e] = *in_memory++;
      const double* next = shares(pose, begin, count);
      for (int j = 0; j < count; ++j, next += kPerCorner) {
        // in registers: as far as the compiler knows, the tile may overlap the shares
        const Real share[3] = {Real(next[0]), Real(next[1]), Real(next[2])};
        for (int r = 0; r < 3; ++r) {
          Real force = tile_[j][r];
          for (int c = 0; c < 3; ++c) force += stress[3 * r + c] * share[c];
          tile_[j][r] = force;
        }
      }
    }
    return count;
  }

  std::size_t center_ = 0;
  int count_ = 0, all_poses_ = 0;
  const std::int32_t* corners_ = nullptr;  // besides the center
  const double *headers_ = nullptr, *shares_ = nullptr;
  std::vector<Real> maps_;
  Real tile_[kTile][3];  // edges from the center, or forces
  Real sum_;
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

/// Turns two stars at once, so that the divisions of one hide the latency of those of the other.
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
  const int count = static_cast<int>(used.size());
  StarSum<Real> one, other;
  Real change[3][3], other_change[3][3], turn[3][3], other_turn[3][3];
  Sum<Real> energy = widened(add_vertices(weights, used, begin, end, u, gradient));
  const int last = first_star(end);
  int star = first_star(begin);
  for (; star + 1 < last; star += 2) {
    one.find_maps(*this, star, used, u);
    other.find_maps(*this, star + 1, used, u);
    for (int i = 0; i < count; ++i) {
      one.find_change(i, used[i], change);
      other.find_change(i, used[i], other_change);
      turn_both(change, other_change, turn, other_turn);
      one.turn(i, used[i], weights[used[i]], turn);
      other.turn(i, used[i], weights[used[i]], other_turn);
    }
    energy += widened(one.finish(used, gradient));
    energy += widened(other.finish(used, gradient));
  }
  if (star == last) return energy;
  one.find_maps(*this, star, used, u);
  for (int i = 0; i < count; ++i) {
    one.find_change(i, used[i], change);
    turn_of(change, turn);
    one.turn(i, used[i], weights[used[i]], turn);
  }
  energy += widened(one.finish(used, gradient));
  return energy;
}

#define SNAPSPACE_DEFINED(Real)                                                                   \
  template Sum<Real> StarBlend::add_value_and_gradient(const Real*, int, int, const Real*, Real*) \
      const;
SNAPSPACE_DOUBLE_LANE_PACKS(SNAPSPACE_DEFINED)
#undef SNAPSPACE_DEFINED

}  // namespace snapspace
