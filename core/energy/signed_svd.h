#pragma once
#include <Eigen/Dense>

namespace snapspace {

/// F = U diag(sigma) V^T with det U = det V = 1: an inverted F shows as a negative last singular
/// value [Irving, Teran, Fedkiw 2004].
struct SignedSvd {
  Eigen::Matrix3d U;
  Eigen::Vector3d sigma;
  Eigen::Matrix3d V;
};

inline SignedSvd signed_svd(const Eigen::Matrix3d& F) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
  SignedSvd result{svd.matrixU(), svd.singularValues(), svd.matrixV()};
  if (result.U.determinant() < 0.0) {
    result.U.col(2) *= -1.0;
    result.sigma[2] *= -1.0;
  }
  if (result.V.determinant() < 0.0) {
    result.V.col(2) *= -1.0;
    result.sigma[2] *= -1.0;
  }
  return result;
}

}  // namespace snapspace
