#include "polish/coarse_space.h"

#include <vector>

namespace snapspace {

CoarseSpace::CoarseSpace(const Numbering& numbering, const double* modes, int dimension,
                         std::size_t size)
    : basis_(static_cast<Eigen::Index>(size), dimension) {
  std::vector<double> mode(size);
  for (int k = 0; k < dimension; ++k) {
    numbering.to_internal(modes + k * size, mode.data());
    basis_.col(k) = Eigen::Map<const Eigen::VectorXd>(mode.data(), basis_.rows()).cast<float>();
  }
}

double CoarseSpace::solve(const Eigen::MatrixXf& inverse, const Eigen::VectorXf& vector,
                          Eigen::VectorXf& correction) const {
  const Eigen::VectorXf coordinates = inverse * (basis_.transpose() * vector);
  correction.noalias() = basis_ * coordinates;
  return vector.cast<double>().dot(correction.cast<double>());
}

}  // namespace snapspace
