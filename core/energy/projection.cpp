#include "energy/projection.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace snapspace {

namespace {

double positive(double eigenvalue, Projection projection) {
  return projection == Projection::absolute ? std::abs(eigenvalue) : std::max(0.0, eigenvalue);
}

template <int Size>
void make_positive(double (&entries)[Size][Size], Projection projection) {
  using Matrix = Eigen::Matrix<double, Size, Size, Eigen::RowMajor>;
  Eigen::Map<Matrix> matrix(&entries[0][0]);
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(matrix);
  if (eigen.eigenvalues()[0] >= 0.0) return;
  const auto values =
      eigen.eigenvalues().unaryExpr([&](double value) { return positive(value, projection); });
  matrix = eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

PrincipalCurvature projected(PrincipalCurvature curvature, Projection projection) {
  if (projection != Projection::clamp && projection != Projection::absolute) return curvature;
  for (int i = 0; i < 3; ++i) {
    curvature.twist[i] = positive(curvature.twist[i], projection);
    curvature.flip[i] = positive(curvature.flip[i], projection);
  }
  make_positive(curvature.scaling, projection);
  return curvature;
}

void project(double (&hessian)[9][9], Projection projection) {
  if (projection != Projection::none) make_positive(hessian, projection);
}

}  // namespace snapspace
