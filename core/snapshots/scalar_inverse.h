#pragma once
#include <Eigen/SparseCore>
#include <memory>
#include <optional>
#include <utility>

#include "cholesky/scalar_factor.h"
#include "cholesky/supernodes.h"
#include "memory/scratch.h"
#include "multigrid/two_grid_cycle.h"

namespace snapspace {

/// What is used as an inverse; automatic leaves the choice to ScalarInverse.
enum class InverseKind { automatic, factor, cycle };

/// The inverse of a scalar n x n matrix, or an approximation for preconditioning: its Cholesky
/// factor where that is small; a multigrid cycle in solid bodies of many vertices, where factors
/// grow like n^(4/3), if the elements are so well shaped that the cycle is near the inverse.
class ScalarInverse {
 public:
  /// @param A  symmetric positive definite, both triangles and the diagonal stored, numbered so
  ///           that neighbours are near each other
  /// @throws std::invalid_argument if A is not positive definite
  explicit ScalarInverse(const Eigen::SparseMatrix<double>& A,
                         InverseKind kind = InverseKind::automatic);

  /// The same for another matrix with A's pattern; the analysis of a factor is reused.
  [[nodiscard]] ScalarInverse of(const Eigen::SparseMatrix<double>& other) const;

  [[nodiscard]] InverseKind kind() const {
    return cycle_ ? InverseKind::cycle : InverseKind::factor;
  }
  /// Lowest eigenvalue of cycle * A if a cycle was made, even if it was then not used.
  [[nodiscard]] std::optional<double> lowest_eigenvalue() const { return lowest_; }
  /// Multiplications per component of a right-hand side, without those by the diagonals.
  [[nodiscard]] std::size_t products() const {
    return cycle_ ? cycle_->products() : 2 * factor_->nonzeros();
  }

  /// solution = (inverse (x) I3) right_hand_side, both 3n; they may be the same array.
  /// @return  right_hand_side . solution
  template <class Real>
  Sum<Real> apply(const Real* right_hand_side, Real* solution, Scratch& scratch) const {
    return cycle_ ? cycle_->apply(right_hand_side, solution, scratch)
                  : factor_->solve(right_hand_side, solution);
  }

 private:
  ScalarInverse(const Eigen::SparseMatrix<double>& A, std::shared_ptr<const Supernodes> known)
      : supernodes_(std::move(known)), factor_(std::in_place, A, *supernodes_) {}

  void make_cycle(const Eigen::SparseMatrix<double>& A);

  std::shared_ptr<const Supernodes> supernodes_;  // supernodes of the factor
  std::optional<ScalarFactor> factor_;
  std::optional<TwoGridCycle> cycle_;
  std::optional<double> lowest_;
};

}  // namespace snapspace
