#include "energy/projection.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace snapspace {

PrincipalCurvature projected(PrincipalCurvature curvature, Projection projection) {
  if (projection != Projection::clamp && projection != Projection::absolute) return curvature;
  const auto positive = [&](double eigenvalue) {
    return projection == Projection::clamp ? std::max(0.0, eigenvalue) : std::abs(eigenvalue);
  };
  for (int i = 0; i < 3; ++i) {
    curvature.twist[i] = positive(curvature.twist[i]);
    curvature.flip[i] = positive(curvature.flip[i]);
  }
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> scaling(&curvature.scaling[0][0]);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(scaling);
  if (eigen.eigenvalues()[0] < 0.0)
    scaling = eigen.eigenvectors() * eigen.eigenvalues().unaryExpr(positive).asDiagonal() *
              eigen.eigenvectors().transpose();
  return curvature;
}

}  // namespace snapspace
