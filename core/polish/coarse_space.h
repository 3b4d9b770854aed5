#pragma once
#include <Eigen/Core>
#include <cstddef>

#include "snapshots/numbering.h"

namespace snapspace {

/// The basis of a subspace in single precision and in a system's internal numbering, for the coarse
/// part of a two-level preconditioner: vector -> U B U^T vector.
class CoarseSpace {
 public:
  /// @param modes  dimension x size, row-major, in the caller's numbering
  CoarseSpace(const Numbering& numbering, const double* modes, int dimension, std::size_t size);

  [[nodiscard]] int dimension() const { return static_cast<int>(basis_.cols()); }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(basis_.rows()); }

  /// correction = U B U^T vector, with B = `inverse`; returns vector . correction.
  double solve(const Eigen::MatrixXf& inverse, const Eigen::VectorXf& vector,
               Eigen::VectorXf& correction) const;

 private:
  Eigen::MatrixXf basis_;
};

}  // namespace snapspace
