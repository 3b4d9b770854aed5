#include "fitting/symmetric_dirichlet.h"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "energy/stvk.h"

namespace snapspace {

namespace {

using Matrix3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Smaller stretches count as this one in the Hessian, though not in the energy: with s^-4 beyond
/// 1e8 the factor of the preconditioner would lose its digits.
constexpr double kLeastStretch = 0.01;

Matrix3 deformation_gradient(const RestTet& tet, const double* u) {
  double G[3][3];
  displacement_gradient(tet, u, G);
  return Eigen::Map<const Matrix3>(&G[0][0]) + Matrix3::Identity();
}

Matrix3 cofactors(const Matrix3& F) {
  Matrix3 C;
  C.row(0) = F.row(1).cross(F.row(2));
  C.row(1) = F.row(2).cross(F.row(0));
  C.row(2) = F.row(0).cross(F.row(1));
  return C;
}

/// Second derivatives of psi by the entries (a, b) of U^T dF V: of each with itself, and of (a, b)
/// with (b, a), which is zero here for a = b. All others vanish.
struct Curvature {
  Eigen::Matrix3d same;
  Eigen::Matrix3d cross;
};

Curvature projected_curvature(const Eigen::Vector3d& stretches) {
  const Eigen::Vector3d s = stretches.cwiseMax(kLeastStretch);
  Curvature result;
  for (int a = 0; a < 3; ++a) {
    const double square = s[a] * s[a];
    result.same(a, a) = 0.5 + 1.5 / (square * square);
    result.cross(a, a) = 0.0;
    for (int b = 0; b < a; ++b) {
      // the quotients of differences and of sums, without a division by zero
      const double product = s[a] * s[b];
      const double cube = product * product * product;
      const double squares = square + s[b] * s[b];
      const double sum = 0.5 + 0.5 * (squares + product) / cube;
      const double difference = std::max(0.0, 0.5 - 0.5 * (squares - product) / cube);
      result.same(a, b) = result.same(b, a) = 0.5 * (sum + difference);
      result.cross(a, b) = result.cross(b, a) = 0.5 * (sum - difference);
    }
  }
  return result;
}

}  // namespace

double symmetric_dirichlet(const RestShape& rest, const double* u, const Distortions& limits,
                           double* gradient, Distortions& distortions) {
  std::fill_n(gradient, 3 * rest.vertex_count, 0.0);
  double value = 0.0;
  for (std::size_t t = 0; t < rest.tets.size(); ++t) {
    const RestTet& tet = rest.tets[t];
    const Matrix3 F = deformation_gradient(tet, u);
    const Matrix3 C = cofactors(F);
    const double det = F.row(0).dot(C.row(0));
    distortions[t] = F.squaredNorm() + C.squaredNorm() / (det * det);
    // written so that NaN is refused as well
    if (!(det > 0.0 && distortions[t] <= limits[t])) return std::numeric_limits<double>::infinity();
    value += tet.volume * 0.25 * (distortions[t] - 6.0);
    // P = (F - F^-T F^-1 F^-T) / 2, and F^-T = C / det; times volume.
    double P[3][3];
    Eigen::Map<Matrix3> stress(&P[0][0]);
    stress = 0.5 * tet.volume * (F - C * (C.transpose() * C) / (det * det * det));
    scatter_stress(tet, P, gradient);
  }
  return value;
}

void assemble_projected(const RestShape& rest, const double* u, BlockHessian& hessian) {
  hessian.clear();
  for (std::size_t t = 0; t < rest.tets.size(); ++t) {
    const RestTet& tet = rest.tets[t];
    const Eigen::Matrix3d F = deformation_gradient(tet, u);
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const Curvature curvature = projected_curvature(svd.singularValues());
    const Eigen::Matrix3d& U = svd.matrixU();

    Eigen::Matrix<double, 3, 4> b;  // gradients of the hat functions, in the frame of V
    for (int j = 0; j < 3; ++j)
      b.col(j + 1) = svd.matrixV().transpose() * Eigen::Vector3d(tet.inverse_edges[j]);
    b.col(0) = -b.rightCols<3>().rowwise().sum();
    const Eigen::Matrix<double, 3, 4> scaled = tet.volume * b;
    for (int j = 0; j < 4; ++j)
      for (int k = 0; k <= j; ++k) {
        Eigen::Matrix3d local = curvature.cross.cwiseProduct(b.col(k) * scaled.col(j).transpose());
        local.diagonal() = curvature.same * scaled.col(j).cwiseProduct(b.col(k));
        const Eigen::Matrix3d block = U * local * U.transpose();
        Eigen::Map<Matrix3>(hessian.block(t, j, k).data()) += block;
        if (j != k) Eigen::Map<Matrix3>(hessian.block(t, k, j).data()) += block.transpose();
      }
  }
}

}  // namespace snapspace
