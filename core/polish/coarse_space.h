#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "snapshots/numbering.h"

namespace snapspace {

/// The columns of a subspace in single precision and in a system's internal numbering, for the
/// coarse part of a two-level preconditioner: vector -> U B U^T vector.
class CoarseSpace {
 public:
  /// @param modes  dimension x size, row-major, in the caller's numbering
  CoarseSpace(const Numbering& numbering, const double* modes, int dimension, std::size_t size)
      : basis_(static_cast<Eigen::Index>(size), dimension) {
    std::vector<double> mode(size);
    for (int k = 0; k < dimension; ++k) {
      numbering.to_internal(modes + k * size, mode.data());
      basis_.col(k) = Eigen::Map<const Eigen::VectorXd>(mode.data(), basis_.rows()).cast<float>();
    }
  }

  [[nodiscard]] int dimension() const { return static_cast<int>(basis_.cols()); }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(basis_.rows()); }

  /// correction = U B U^T vector, with B = `inverse`.
  void solve(const Eigen::MatrixXf& inverse, const Eigen::VectorXf& vector,
             Eigen::VectorXf& correction) const {
    const Eigen::VectorXf coordinates = inverse * (basis_.transpose() * vector);
    correction.noalias() = basis_ * coordinates;
  }

 private:
  Eigen::MatrixXf basis_;
};

}  // namespace snapspace
