#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "cholesky/point.h"
#include "cholesky/scalar_factor.h"
#include "memory/scratch.h"
#include "memory/streamed_vector.h"
#include "simd/packs.h"

namespace snapspace {

/// A multigrid cycle in place of the inverse of a scalar n x n matrix A, applied to x, y, z (and to
/// all lanes) at once: a Gauss-Seidel sweep, smoothed aggregation to a coarse grid (Vanek, Mandel,
/// Brezina 1996) with a Cholesky factor there, and a sweep back.
/// The coarse grid has a fifteenth of the unknowns, so the cost of its factor is negligible: a
/// cycle costs the same per vertex in small and large meshes, whereas the triangular solves of a
/// solid body grow like n^(4/3). The cycle is symmetric and positive definite, since Gauss-Seidel
/// converges for every such A, and at most A^-1: eigenvalues of cycle * A are in (0, 1]. How near
/// to 1 they are depends on the shapes of the elements, not on their number.
class TwoGridCycle {
 public:
  /// @param A  symmetric positive definite, both triangles and the diagonal stored, numbered so
  ///           that neighbours are near each other
  /// @throws std::invalid_argument if A is not positive definite
  explicit TwoGridCycle(const Eigen::SparseMatrix<double>& A);

  [[nodiscard]] std::size_t size() const { return inverse_diagonal_.size(); }
  [[nodiscard]] std::size_t coarse_size() const { return coarse_.size(); }
  /// Multiplications per component of a right-hand side, without those by the diagonals.
  [[nodiscard]] std::size_t products() const {
    return 2 * (links_.size() + parents_.size() + coarse_.nonzeros());
  }

  /// solution = cycle * right_hand_side, both 3n; they may be the same array.
  /// @return  right_hand_side . solution
  template <class Real>
  Sum<Real> apply(const Real* right_hand_side, Real* solution, Scratch& scratch) const;

 private:
  using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  struct Link {
    std::int32_t vertex;
    float weight;
  };
  /// Where a vertex's links begin: those to earlier neighbours, to later ones, and to parents.
  struct Row {
    std::int32_t links, later, parents;
  };

  TwoGridCycle(const Eigen::SparseMatrix<double>& A, const Rows& prolongation);
  void add_row(const Eigen::SparseMatrix<double>& A, const Rows& prolongation, std::int32_t i);

  /// y -= the sum over some links of weight * x
  template <class Real>
  static void subtract(const Link* link, const Link* end, const Real* x, Point<Real>& y);
  /// b / a_ii
  template <class Real>
  Point<Real> scaled(const Real* b, std::int32_t i) const {
    auto y = Point<Real>::zero();
    y.subtract(-inverse_diagonal_[i], Point<Real>::at(b + 3 * std::size_t(i)));
    return y;
  }

  template <class Real>
  void sweep_down(std::int32_t i, const Real* b, Real* x) const;
  template <class Real>
  void restrict_residual(std::int32_t i, const Real* x, Real* coarse) const;
  template <class Real>
  void prolong(std::int32_t i, const Real* coarse, Real* x) const;
  template <class Real>
  Sum<Real> sweep_up(std::int32_t i, const Real* b, Real* x, Real* solution) const;

  template <class Real>
  void descend(const Real* b, Real* x, Real* coarse) const;
  template <class Real>
  Sum<Real> ascend(const Real* coarse, const Real* b, Real* x, Real* solution) const;

  /// Vertices by which the first part of a leg advances at a time.
  static constexpr std::int32_t kRows = 32;

  ScalarFactor coarse_;
  StreamedVector<float> inverse_diagonal_;
  std::vector<Row> rows_;            // and one past the last
  StreamedVector<Link> links_;       // a_ij / a_ii of the neighbours j, ascending
  StreamedVector<Link> parents_;     // the prolongation
  std::vector<std::int32_t> first_;  // first neighbour of a vertex and of all later ones
  std::vector<std::int32_t> last_;   // last neighbour of a vertex and of all earlier ones
};

#define SNAPSPACE_DECLARED(Real) \
  extern template Sum<Real> TwoGridCycle::apply(const Real*, Real*, Scratch&) const;
SNAPSPACE_PACKS(SNAPSPACE_DECLARED)
#undef SNAPSPACE_DECLARED

}  // namespace snapspace
