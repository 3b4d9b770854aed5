#include "patches/patch_hessian.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "material/principal_curvature.h"
#include "material/signed_svd.h"

namespace snapspace {

namespace {

/// Growth of the shift.
constexpr double kMoreShift = 4.0, kMostShift = 1e6;
/// Smallest sum of two stretches of a star; below it, the rotation is hardly defined.
constexpr double kLeastStretches = 0.05;

/// The sum of hat (x) gradient over corners. In a function of its own, because sums stay in
/// registers there; even and odd ones do not wait for each other.
[[gnu::noinline]] Eigen::Matrix<double, 4, 3> moments_of(int count, const double* gradient,
                                                         const Eigen::Vector4d* hat) {
  const Eigen::Vector4d zero = Eigen::Vector4d::Zero();
  Eigen::Vector4d x = zero, y = zero, z = zero, odd_x = zero, odd_y = zero, odd_z = zero;
  for (int c = 0; c + 1 < count; c += 2, hat += 2, gradient += 6) {
    x += gradient[0] * hat[0];
    y += gradient[1] * hat[0];
    z += gradient[2] * hat[0];
    odd_x += gradient[3] * hat[1];
    odd_y += gradient[4] * hat[1];
    odd_z += gradient[5] * hat[1];
  }
  if (count % 2 == 1) {
    x += gradient[0] * hat[0];
    y += gradient[1] * hat[0];
    z += gradient[2] * hat[0];
  }
  Eigen::Matrix<double, 4, 3> result;
  result << x + odd_x, y + odd_y, z + odd_z;
  return result;
}

}  // namespace

PatchHessian::PatchHessian(const RigidPatches& patches, const double* u)
    : patches_(patches),
      positions_(patches.positions()),
      centers_(3 * static_cast<std::size_t>(patches.count()), 0.0),
      dirichlet_(Square::Zero(patches.dimension(), patches.dimension())),
      rotations_(dirichlet_),
      slots_(patches.count(), -1) {
  const int vertices = patches.vertices();
  Vector mean = Vector::Zero();
  for (int i = 0; i < 3 * vertices; ++i) positions_[i] += u[i];
  for (int i = 0; i < vertices; ++i) mean += position(i) / vertices;
  std::vector<double> hats(patches.count(), 0.0);
  for (int i = 0; i < vertices; ++i) {
    for (int r = 0; r < 3; ++r) positions_[3 * static_cast<std::size_t>(i) + r] -= mean[r];
    for (const auto* place = patches.begin(i); place != patches.end(i); ++place) {
      hats[place->patch] += place->hat;
      for (int r = 0; r < 3; ++r)
        centers_[3 * static_cast<std::size_t>(place->patch) + r] += place->hat * position(i)[r];
    }
  }
  for (std::size_t i = 0; i < centers_.size(); ++i) centers_[i] /= hats[i / 3];
}

void PatchHessian::add(const std::vector<Part>& parts) {
  if (parts.empty()) return;
  const VertexStars& pattern = *parts[0].stars;
  std::vector<double> couplings(pattern.couplings.size(), 0.0);
  for (const Part& part : parts)
    for (std::size_t k = 0; k < couplings.size(); ++k)
      couplings[k] += part.weight * part.stars->couplings[k];
  add_couplings(pattern, couplings);
  for (int star = 0; star < pattern.count(); ++star) add_stars(parts, star);
}

void PatchHessian::forget_touched() {
  for (const std::int32_t patch : touched_) slots_[patch] = -1;
  touched_.clear();
  hats_.clear();
}

/// The place of a patch among those touched; if it is a new one, it gets `count` hats of zero.
std::size_t PatchHessian::touch(std::int32_t patch, int count) {
  int& slot = slots_[patch];
  if (slot < 0) {
    slot = static_cast<int>(touched_.size());
    touched_.push_back(patch);
    hats_.resize(hats_.size() + count, Homogeneous::Zero());
  }
  return static_cast<std::size_t>(slot);
}

/// Sets the hats of all patches at the corners of an element, patch by patch.
void PatchHessian::find_hats(int count, const std::int32_t* corners) {
  forget_touched();
  for (int c = 0; c < count; ++c) {
    const int vertex = corners[c];
    for (const auto* place = patches_.begin(vertex); place != patches_.end(vertex); ++place) {
      const std::size_t slot = touch(place->patch, count);
      hats_[slot * count + c] = homogeneous(vertex, place->hat);
    }
  }
}

/// With S = F L^T = U diag(s) V^T, the part of a star's energy that depends on its rotation is -2
/// weight (s_1 + s_2 + s_3), whose Hessian is -2 weight sum_{i < j} (A_ij - A_ji)^2 / (s_i + s_j)
/// with A = U^T dF L^T V. So only three numbers of a motion matter to a star in each part.
void PatchHessian::add_stars(const std::vector<Part>& parts, int star) {
  const VertexStars& stars = *parts[0].stars;
  const int first = stars.first_corner[star];
  find_hats(stars.first_corner[star + 1] - first, &stars.corners[first]);
  moments_.resize(touched_.size());
  felt_.resize(touched_.size());
  for (const Part& part : parts) add_rotation(part, star);
}

void PatchHessian::add_rotation(const Part& part, int star) {
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  const VertexStars& stars = *part.stars;
  const int first = stars.first_corner[star], count = stars.first_corner[star + 1] - first;
  const double* const gradients = &stars.gradients[3 * static_cast<std::size_t>(first)];
  Matrix F = Matrix::Zero();  // map of the whole shape, since the hats sum to one
  for (std::size_t m = 0; m < touched_.size(); ++m) {
    moments_[m] = moments_of(count, gradients, &hats_[m * count]);
    F += moments_[m].bottomRows<3>();
  }
  const Matrix L = Eigen::Map<const Rows>(&stars.frames[9 * static_cast<std::size_t>(star)]);
  double S[3][3];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) S[r][c] = F.row(r).dot(L.row(c));
  const SignedSvd svd(S);
  const Matrix U = Eigen::Map<const Rows>(&svd.U[0][0]);
  const Matrix LV = L.transpose() * Eigen::Map<const Rows>(&svd.V[0][0]);
  Vector weights;
  for (int p = 0; p < 3; ++p) {
    const int i = kPairs[p][0], j = kPairs[p][1];
    const double sum = std::max(svd.s[i] + svd.s[j], kLeastStretches);
    weights[p] = 2.0 * part.weight * stars.weights[star] / sum;
    const Matrix N = U.col(i) * LV.col(j).transpose() - U.col(j) * LV.col(i).transpose();
    for (std::size_t m = 0; m < touched_.size(); ++m) {
      const Vector shift = moments_[m].row(0), at = center(touched_[m]);
      Vector turn = Vector::Zero();
      for (int k = 0; k < 3; ++k) {
        const Vector moved = moments_[m].col(k).tail<3>() - shift[k] * at;
        turn += moved.cross(Vector(N.col(k)));
      }
      felt_[m].col(p).head<3>() = N * shift;
      felt_[m].col(p).tail<3>() = turn;
    }
  }
  for (std::size_t a = 0; a < touched_.size(); ++a) {
    const Eigen::Matrix<double, kMotions, 3> weighted = felt_[a] * weights.asDiagonal();
    for (std::size_t b = 0; b < touched_.size(); ++b)
      if (touched_[b] <= touched_[a])
        rotations_.block<kMotions, kMotions>(kMotions * touched_[a], kMotions * touched_[b]) -=
            weighted * felt_[b].transpose();
  }
}

/// Adds the Hessian of sum_ij coupling_ij u_i . (u_j - u_i). The matrix of the couplings acts on
/// the hats, and on the hats times x, y and z; motions combine these.
void PatchHessian::add_couplings(const VertexStars& pattern, const std::vector<double>& couplings) {
  const int count = patches_.count();
  std::vector<Eigen::Matrix4d> sums(static_cast<std::size_t>(count) * count,
                                    Eigen::Matrix4d::Zero());
  for (int i = 0; i < patches_.vertices(); ++i) {
    forget_touched();
    const auto add = [&](int vertex, double coupling) {
      for (const auto* place = patches_.begin(vertex); place != patches_.end(vertex); ++place) {
        const std::size_t slot = touch(place->patch, 1);
        hats_[slot] += homogeneous(vertex, 2.0 * coupling * place->hat);
      }
    };
    double own = 0.0;
    for (int k = pattern.first_neighbour[i]; k < pattern.first_neighbour[i + 1]; ++k) {
      own -= couplings[k];
      add(pattern.neighbours[k], couplings[k]);
    }
    add(i, own);
    for (const auto* place = patches_.begin(i); place != patches_.end(i); ++place) {
      const Homogeneous of_place = homogeneous(i, place->hat);
      for (std::size_t k = 0; k < touched_.size(); ++k)
        if (touched_[k] <= place->patch)
          sums[static_cast<std::size_t>(place->patch) * count + touched_[k]].noalias() +=
              of_place * hats_[k].transpose();
    }
  }
  const auto cross = [](const Vector& v) {
    Matrix result;
    result << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
    return result;
  };
  for (int a = 0; a < count; ++a)
    for (int b = 0; b <= a; ++b) {
      const Eigen::Matrix4d& sum = sums[static_cast<std::size_t>(a) * count + b];
      const double hats = sum(0, 0);
      if (hats == 0.0) continue;
      const Vector x = sum.block<3, 1>(1, 0) - hats * center(a);  // of a
      const Vector y = Vector(sum.block<1, 3>(0, 1).transpose()) - hats * center(b);
      const Matrix xy = sum.block<3, 3>(1, 1) - center(a) * sum.block<1, 3>(0, 1) -
                        sum.block<3, 1>(1, 0) * center(b).transpose() +
                        hats * center(a) * center(b).transpose();
      auto block = dirichlet_.block<kMotions, kMotions>(kMotions * a, kMotions * b);
      block.topLeftCorner<3, 3>() += hats * Matrix::Identity();
      block.topRightCorner<3, 3>() -= cross(y);
      block.bottomLeftCorner<3, 3>() += cross(x);
      block.bottomRightCorner<3, 3>() += xy.trace() * Matrix::Identity() - xy.transpose();
    }
}

/// Only makes the matrix regular: forces sum to zero.
void PatchHessian::hold_translations() {
  double stiffness = 0.0;
  for (int a = 0; a < patches_.count(); ++a)
    stiffness += dirichlet_(kMotions * a, kMotions * a) / patches_.count();
  stiffness /= patches_.count();
  for (int a = 0; a < patches_.count(); ++a)
    for (int b = 0; b <= a; ++b)
      for (int r = 0; r < 3; ++r) dirichlet_(kMotions * a + r, kMotions * b + r) += stiffness;
}

/// A patch of one or two vertices may turn without moving them.
void PatchHessian::hold_small_patches() {
  constexpr double kLeast = 1e-6;  // share of the mean stiffness
  double sum = 0.0;
  for (int a = 0; a < patches_.count(); ++a)
    for (int r = 3; r < kMotions; ++r) sum += dirichlet_(kMotions * a + r, kMotions * a + r);
  for (int a = 0; a < patches_.count(); ++a)
    for (int r = 3; r < kMotions; ++r)
      dirichlet_(kMotions * a + r, kMotions * a + r) += kLeast * sum / (3 * patches_.count());
}

std::optional<online::DenseCholesky> PatchHessian::factor() {
  hold_translations();
  hold_small_patches();
  const int d = patches_.dimension();
  online::DenseCholesky result(d);
  for (double shift = shift_; shift < kMostShift; shift *= kMoreShift) {
    const Square sum = (1.0 + shift) * dirichlet_ + rotations_;
    if (result.factor(sum.data(), d) < 0) return result;
  }
  return std::nullopt;
}

}  // namespace snapspace
