#include "snapshots/scalar_inverse.h"

#include <stdexcept>
#include <utility>

#include "cholesky/analysis.h"
#include "multigrid/lowest_eigenvalue.h"

namespace snapspace {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Smallest eigenvalue of cycle * A with which the cycle is used. Bodies filled with regular tets
/// have 0.35 to 0.45: their samples take a tenth more evaluations than with the factor, and the
/// first ones, from rest, a quarter more. With 0.25 and less they take twice as many.
constexpr double kMinEigenvalue = 0.3;

}  // namespace

ScalarInverse::ScalarInverse(const Matrix& A, InverseKind kind) {
  if (kind == InverseKind::cycle) {
    make_cycle(A);
    return;
  }
  Supernodes supernodes = by_minimum_degree(A);
  if (is_dense(supernodes)) {
    if (kind == InverseKind::automatic) {
      try {
        make_cycle(A);
        if (*lowest_ >= kMinEigenvalue) return;
      } catch (const std::invalid_argument&) {  // the coarse matrix; the factor of A will report it
      }
      cycle_.reset();
    }
    supernodes = or_by_dissection(A, std::move(supernodes));
  }
  supernodes_ = std::make_shared<const Supernodes>(std::move(supernodes));
  factor_.emplace(A, *supernodes_);
}

void ScalarInverse::make_cycle(const Matrix& A) {
  cycle_.emplace(A);
  lowest_ = snapspace::lowest_eigenvalue(A, *cycle_);
}

ScalarInverse ScalarInverse::of(const Matrix& other) const {
  return factor_ ? ScalarInverse(other, supernodes_) : ScalarInverse(other);
}

}  // namespace snapspace
