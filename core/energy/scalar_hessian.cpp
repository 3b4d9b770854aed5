#include "energy/scalar_hessian.h"

namespace snapspace {

namespace {

/// C with its eigenvalues raised to at least one.
Eigen::Matrix3d clamped(const Eigen::Matrix3d& C) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(C);
  if (eigen.eigenvalues()[0] >= 1.0) return C;
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(1.0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace

void ScalarHessian::add(const ElasticEnergy& energy, const double* u, double weight) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const double mu = energy.material.mu, lam = energy.material.lam;
  for (std::size_t t = 0; t < locals_.size(); ++t) {
    const RestTet& tet = energy.rest.tets[t];
    double G[3][3];
    displacement_gradient(tet, u, G);
    const Eigen::Matrix3d F =
        I + Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&G[0][0]);
    const Eigen::Matrix3d C = clamped(F.transpose() * F);
    const Eigen::Matrix3d E = 0.5 * (C - I);
    const Eigen::Matrix3d S = 2.0 * mu * E + lam * E.trace() * I;
    const Eigen::Matrix3d D = (mu * C.trace() * I + (mu + lam) * C) / 3.0 + S;
    const Eigen::Matrix<double, 4, 3> b = hat_gradients(tet);
    locals_[t] += (weight * tet.volume) * b * D * b.transpose();
  }
}

}  // namespace snapspace
