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
    Eigen::Matrix<double, 4, 3> b;  // gradients of the hat functions; they sum to zero
    for (int j = 0; j < 3; ++j) b.row(j + 1) = Eigen::RowVector3d(tet.inverse_edges[j]);
    b.row(0) = -b.bottomRows<3>().colwise().sum();
    locals_[t] += (weight * tet.volume) * b * D * b.transpose();
  }
}

Eigen::SparseMatrix<double> ScalarHessian::matrix() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(tets_.size() * 16);
  for (std::size_t t = 0; t < tets_.size(); ++t)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        entries.emplace_back(tets_[t].vertices[a], tets_[t].vertices[b], locals_[t](a, b));
  Eigen::SparseMatrix<double> A(vertex_count_, vertex_count_);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

}  // namespace snapspace
