#include "online/blended_cubature.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "element/make_rest_element.h"
#include "element/tet.h"
#include "material/pose_blend.h"
#include "material/principal_hessian.h"
#include "material/shell_rest.h"
#include "online/block_sums.h"
#include "online/tet_density.h"

namespace snapspace::online {

namespace {

constexpr int kWidth = TetRows::kWidth;
constexpr std::int32_t kCorners[4] = {0, 1, 2, 3}, kTriangle[4] = {0, 1, 2, 2};

/// Displacement gradient of an element that moves from one position (4 x 3) to another, with
/// respect to the first.
void gradient_between(const RestTet& rest, const double* from, const double* to, double G[3][3]) {
  double moved[12];
  for (int i = 0; i < 12; ++i) moved[i] = to[i] - from[i];
  displacement_gradient(rest, moved, G);
}

}  // namespace

BlendedCubature::BlendedCubature(int dimension, int tets, const float* rows, const double* weights,
                                 const TetMaterial& material, const PoseTets& poses,
                                 const RowClusters& clusters)
    : rows_(dimension, tets, rows, clusters),
      second_half_(static_cast<std::size_t>(dimension) * dimension),
      kind_(material.kind),
      poses_(poses.poses),
      moduli_count_(material_moduli(material.kind)),
      weights_(poses.poses, 0.0),
      offsets_(9 * static_cast<std::size_t>(rows_.blocks()), Tets(0.0)) {
  Densities::with(kind_, [&]<class Density>() {
    numbers_count_ = PoseBlend<Density>::numbers();
    sums_count_ = numbers_count_ - PoseBlend<Density>::constants();
    collapses_ = PoseBlend<Density>::kCollapses;
  });
  const std::size_t pairs = static_cast<std::size_t>(tets) * poses_;
  maps_.resize(9 * pairs);
  moduli_.resize(moduli_count_ * pairs);
  const std::size_t packs = static_cast<std::size_t>(rows_.blocks()) * numbers_count_;
  numbers_.assign(packs * poses_, Tets(0.0));
  blend_.assign(std::max<std::size_t>(packs, poses_), Tets(0.0));
  for (int tet = 0; tet < tets; ++tet) set_tet(tet, weights[tet], material.of(tet), poses);
}

void BlendedCubature::set_tet(int tet, double weight, const double* moduli, const PoseTets& poses) {
  const int block = tet / kWidth, lane = tet % kWidth;
  const bool shell = is_of_shells(kind_);
  const std::int32_t* order = shell && moduli[0] > 0.0 ? kTriangle : kCorners;
  const auto corners = [&](int pose) {
    return poses.corners + 12 * (static_cast<std::size_t>(pose) * rows_.tets() + tet);
  };
  const RestTet first = make_rest_element(shell, corners(0), order);
  double G[3][3];
  gradient_between(first, corners(0), poses.tau + 12 * static_cast<std::size_t>(tet), G);
  for (int e = 0; e < 9; ++e) offsets_[9 * block + e].set(lane, G[e / 3][e % 3]);
  const double share = weight / first.volume;
  std::vector<double> numbers(numbers_count_);
  for (int k = 0; k < poses_; ++k) {
    const std::size_t pair = static_cast<std::size_t>(tet) * poses_ + k;
    const RestTet rest = make_rest_element(shell, corners(k), order);
    // F A = F + F map: the map is pose 0's displacement gradient relative to pose k
    double map[3][3];
    gradient_between(rest, corners(k), corners(0), map);
    for (int e = 0; e < 9; ++e) maps_[9 * pair + e] = map[e / 3][e % 3];
    double* weighted = moduli_.data() + moduli_count_ * pair;
    scale_moduli(kind_, moduli, share * rest.volume, weighted);
    if (shell && k > 0) set_rest_shape(kind_, corners(k), order, 0.0, weighted);
    Densities::with(kind_, [&]<class Density>() {
      PoseBlend<Density>::fill(weighted, moduli, map, numbers.data());
    });
    for (int i = 0; i < numbers_count_; ++i)
      numbers_[(static_cast<std::size_t>(block) * poses_ + k) * numbers_count_ + i].set(lane,
                                                                                        numbers[i]);
  }
}

void BlendedCubature::set_weights(const double* weights) {
  std::copy_n(weights, poses_, weights_.data());
  if (!collapses_) {
    for (int k = 0; k < poses_; ++k) blend_[k] = Tets(weights[k]);
    return;
  }
  const Tets* numbers = numbers_.data();
  Tets* sums = blend_.data();
  for (int b = 0; b < rows_.blocks(); ++b, sums += numbers_count_) {
    std::fill_n(sums, sums_count_, Tets(0.0));
    std::copy(numbers + sums_count_, numbers + numbers_count_, sums + sums_count_);
    for (int k = 0; k < poses_; ++k, numbers += numbers_count_)
      for (int i = 0; i < sums_count_; ++i) sums[i] += Tets(weights[k]) * numbers[i];
  }
}

/// Displacement gradients relative to pose 0, from those of the modes.
void BlendedCubature::add_offsets(int block, const Tets modes[3][3], Tets G[3][3]) const {
  for (int e = 0; e < 9; ++e) G[e / 3][e % 3] = modes[e / 3][e % 3] + offsets_[9 * block + e];
}

double BlendedCubature::value_and_gradient(const double* q, double* gradient) {
  return block_sum(rows_, half_runner_, q, *this, gradient);
}

BlendedCubature::Tets BlendedCubature::block_energy(int block, const Tets modes[3][3],
                                                    Tets P[3][3]) const {
  Tets G[3][3];
  add_offsets(block, modes, G);
  if (collapses_)
    return Densities::with(kind_, [&]<class Density>() {
      if constexpr (PoseBlend<Density>::kCollapses)
        return Density::Blend::value_and_stress(blend_.data() + block * numbers_count_, G, P);
      else
        return Tets(0.0);  // unreachable
    });
  const Tets* numbers = numbers_.data() + static_cast<std::size_t>(block) * poses_ * numbers_count_;
  return sum_over_poses(poses_, moduli_count_, blend_.data(), numbers, G, P,
                        [this](const Tets* moduli, const Tets at[3][3], Tets stress[3][3]) {
                          return online::value_and_stress(kind_, moduli, at, stress);
                        });
}

/// Adds the pose's weight times the Hessian of a tet's energy relative to a pose, with respect to
/// its displacement gradient relative to pose 0: dP = P'(dF A) A^T.
void BlendedCubature::add_curvature(int tet, int pose, const double G[3][3],
                                    double hessian[9][9]) const {
  const std::size_t pair = static_cast<std::size_t>(tet) * poses_ + pose;
  const double* map = maps_.data() + 9 * pair;
  double A[3][3], pose_G[3][3], change[3][3], stress[3][3];
  for (int e = 0; e < 9; ++e) A[e / 3][e % 3] = map[e] + (e % 4 == 0 ? 1.0 : 0.0);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      pose_G[r][c] = map[3 * r + c] + G[r][0] * A[0][c] + G[r][1] * A[1][c] + G[r][2] * A[2][c];
  const PrincipalHessian principal({kind_, 1, moduli_.data() + moduli_count_ * pair}, 0, pose_G);
  for (int e = 0; e < 9; ++e) {
    for (int f = 0; f < 9; ++f) change[f / 3][f % 3] = f / 3 == e / 3 ? A[e % 3][f % 3] : 0.0;
    principal.multiply(change, stress);
    for (int f = 0; f < 9; ++f) {
      const double *P = stress[f / 3], *row = A[f % 3];
      hessian[f][e] += weights_[pose] * (P[0] * row[0] + P[1] * row[1] + P[2] * row[2]);
    }
  }
}

/// Sets a shell element's Hessian with respect to its displacement gradient relative to pose 0.
void BlendedCubature::shell_curvature(int block, int lane, const double G[3][3],
                                      double hessian[9][9]) const {
  Densities::with(kind_, [&]<class Density>() {
    if constexpr (kOfHinges<Density>) {
      double numbers[Density::Blend::kNumbers];
      for (int i = 0; i < numbers_count_; ++i)
        numbers[i] = blend_[static_cast<std::size_t>(block) * numbers_count_ + i][lane];
      Density::Blend::hessian(numbers, G, hessian);
    }
  });
}

/// Hessians (9 x 9) of a block's tets for the weights of the poses; zero for lanes without a tet.
void BlendedCubature::block_curvatures(int block, const Tets modes[3][3],
                                       Tets hessian[9][9]) const {
  Tets G[3][3];
  add_offsets(block, modes, G);
  for (int f = 0; f < 9; ++f) std::fill_n(hessian[f], 9, Tets(0.0));
  for (int lane = 0; lane < rows_.lanes(block); ++lane) {
    double own[3][3], sum[9][9] = {};
    for (int e = 0; e < 9; ++e) own[e / 3][e % 3] = G[e / 3][e % 3][lane];
    if (is_of_shells(kind_)) {
      shell_curvature(block, lane, own, sum);
    } else {
      for (int k = 0; k < poses_; ++k)
        if (weights_[k] != 0.0) add_curvature(block * kWidth + lane, k, own, sum);
    }
    for (int e = 0; e < 81; ++e) hessian[e / 9][e % 9].set(lane, sum[e / 9][e % 9]);
  }
}

double BlendedCubature::derivatives(const double* q, double* gradient, double* hessian) {
  const double value = value_and_gradient(q, gradient);
  const auto d = static_cast<std::size_t>(dimension());
  std::fill_n(hessian, d * d, 0.0);
  add_block_hessians(rows_, half_runner_, second_half_, *this, hessian);
  return value;
}

void BlendedCubature::curvatures(const double* q, float* hessians) {
  rows_.begin(q);
  rows_.store_curvatures(*this, hessians);
}

void BlendedCubature::stresses(const double* q, float* stresses) {
  rows_.begin(q);
  rows_.store_stresses(*this, stresses);
}

}  // namespace snapspace::online
