#include "energy/block_hessian.h"

#include <Eigen/Dense>
#include <algorithm>

#include "energy/signed_svd.h"

namespace snapspace {

namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Makes G that of the clamped state; leaves it where no singular value is below the threshold.
void clamp_singular_values(double G[3][3], double threshold) {
  Eigen::Map<Matrix3> gradient(&G[0][0]);
  const Eigen::Matrix3d F = gradient + Eigen::Matrix3d::Identity();
  // Most elements need no clamping, and the eigenvalues of F^T F say so without an SVD.
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> stretch;
  stretch.computeDirect(F.transpose() * F, Eigen::EigenvaluesOnly);
  const double margin = threshold * (1.0 + 1e-6);
  if (stretch.eigenvalues()[0] >= margin * margin && F.determinant() > 0.0) return;
  const SignedSvd svd = signed_svd(F);
  gradient = svd.U * svd.sigma.cwiseMax(threshold).asDiagonal() * svd.V.transpose();
  gradient -= Eigen::Matrix3d::Identity();
}

}  // namespace

BlockHessian::BlockHessian(const RestShape& rest) : slots_(rest.tets.size()) {
  std::vector<std::vector<std::int32_t>> neighbours(rest.vertex_count);
  for (const RestTet& tet : rest.tets)
    for (const std::int32_t a : tet.vertices)
      neighbours[a].insert(neighbours[a].end(), tet.vertices, tet.vertices + 4);
  row_start_.reserve(rest.vertex_count + 1);
  row_start_.push_back(0);
  for (auto& row : neighbours) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    columns_.insert(columns_.end(), row.begin(), row.end());
    row_start_.push_back(static_cast<std::int32_t>(columns_.size()));
  }
  blocks_.resize(columns_.size());
  for (std::size_t t = 0; t < rest.tets.size(); ++t)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const std::int32_t row = rest.tets[t].vertices[a];
        const auto begin = columns_.begin() + row_start_[row];
        const auto end = columns_.begin() + row_start_[row + 1];
        const auto at = std::lower_bound(begin, end, rest.tets[t].vertices[b]);
        slots_[t][4 * a + b] = static_cast<std::int32_t>(at - columns_.begin());
      }
}

void BlockHessian::clear() { std::fill(blocks_.begin(), blocks_.end(), std::array<double, 9>{}); }

void BlockHessian::add(const ElasticEnergy& energy, const double* u, double clamp, double weight) {
  for (std::size_t t = 0; t < slots_.size(); ++t) {
    const RestTet& tet = energy.rest.tets[t];
    double G[3][3];
    displacement_gradient(tet, u, G);
    if (clamp > kUnclamped) clamp_singular_values(G, clamp);
    add_element(energy.material, tet, weight * tet.volume, slots_[t], G);
  }
}

void BlockHessian::add_element(const StVK& material, const RestTet& tet, double volume,
                               const std::array<std::int32_t, 16>& slots, const double G[3][3]) {
  double S_array[3][3];
  stress(material, G, S_array);
  const Eigen::Map<const Matrix3> S(&S_array[0][0]);
  const Eigen::Matrix3d F = Eigen::Map<const Matrix3>(&G[0][0]) + Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d left_cauchy_green = F * F.transpose();

  Eigen::Matrix<double, 3, 4> b;  // gradients of the hat functions
  for (int j = 0; j < 3; ++j) b.col(j + 1) = Eigen::Vector3d(tet.inverse_edges[j]);
  b.col(0) = -b.rightCols<3>().rowwise().sum();
  const Eigen::Matrix<double, 3, 4> Fb = F * b;
  const Eigen::Matrix<double, 3, 4> Sb = S * b;

  // Second derivative of volume * psi by vertices j and k: dP = dF S + F dS with dF = v (x) b_k.
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k) {
      Eigen::Map<Matrix3> block(blocks_[slots[4 * j + k]].data());
      block += volume * (material.mu * b.col(j).dot(b.col(k)) * left_cauchy_green +
                         material.mu * Fb.col(k) * Fb.col(j).transpose() +
                         material.lam * Fb.col(j) * Fb.col(k).transpose());
      block.diagonal().array() += volume * b.col(j).dot(Sb.col(k));
    }
}

void BlockHessian::add_to_diagonal(int vertex, double value) {
  const auto begin = columns_.begin() + row_start_[vertex];
  const auto end = columns_.begin() + row_start_[vertex + 1];
  auto& block = blocks_[std::lower_bound(begin, end, vertex) - columns_.begin()];
  for (int r = 0; r < 3; ++r) block[4 * r] += value;
}

void BlockHessian::multiply(const double* v, double* product) const {
  const std::size_t n = row_start_.size() - 1;
  for (std::size_t row = 0; row < n; ++row) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::int32_t k = row_start_[row]; k < row_start_[row + 1]; ++k)
      sum += Eigen::Map<const Matrix3>(blocks_[k].data()) *
             Eigen::Map<const Eigen::Vector3d>(v + 3 * columns_[k]);
    Eigen::Map<Eigen::Vector3d>(product + 3 * row) = sum;
  }
}

}  // namespace snapspace
