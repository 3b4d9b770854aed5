#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <vector>

#include "cholesky/point.h"
#include "cholesky/scalar_factor.h"
#include "memory/scratch.h"
#include "memory/streamed_vector.h"
#include "simd/lanes.h"

namespace snapspace {

/// A multigrid cycle in place of the inverse of a scalar n x n matrix A, applied to x, y, z (and to
/// all lanes) at once: a Gauss-Seidel sweep, smoothed aggregation to a coarse grid (Vanek, Mandel,
/// Brezina 1996) with a Cholesky factor there, and a sweep back.
///
/// The coarse grid has a fifteenth of the unknowns, so that its factor hardly counts: a cycle costs
/// the same per vertex in small and large meshes, where the triangular solves of a solid body grow
/// like n^(4/3). It is symmetric and positive definite, since Gauss-Seidel converges for every such
/// A, and never further than A^-1: eigenvalues of cycle * A are in (0, 1]. How near to 1 depends on
/// the shapes of the elements and not on their number.
class TwoGridCycle {
 public:
  /// @param A  symmetric positive definite, both triangles and the diagonal stored, numbered so
  ///           that neighbours are near each other
  /// @throws std::invalid_argument if A is not positive definite
  explicit TwoGridCycle(const Eigen::SparseMatrix<double>& A);

  [[nodiscard]] std::size_t size() const { return inverse_diagonal_.size(); }
  [[nodiscard]] std::size_t coarse_size() const { return coarse_.size(); }
  /// Multiplications per component of a right-hand side, but for the diagonals.
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
  /// Where a vertex' links are: those to earlier neighbours, to later ones, and to parents.
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

  /// Vertices that the first part of a leg goes ahead with at a time.
  static constexpr std::int32_t kRows = 32;

  ScalarFactor coarse_;
  StreamedVector<float> inverse_diagonal_;
  std::vector<Row> rows_;            // and one behind the last
  StreamedVector<Link> links_;       // a_ij / a_ii of the neighbours j, ascending
  StreamedVector<Link> parents_;     // the prolongation
  std::vector<std::int32_t> first_;  // of the neighbours of a vertex and of those behind it
  std::vector<std::int32_t> last_;   // of a vertex and of those before it
};

template <class Real>
void TwoGridCycle::subtract(const Link* link, const Link* end, const Real* x, Point<Real>& y) {
  const auto point = [&](std::int32_t v) { return Point<Real>::at(x + 3 * std::size_t(v)); };
  auto odd = Point<Real>::zero();
  for (; link + 1 < end; link += 2) {
    y.subtract(link[0].weight, point(link[0].vertex));
    odd.subtract(link[1].weight, point(link[1].vertex));
  }
  if (link < end) y.subtract(link->weight, point(link->vertex));
  y.add(odd);
}

/// From x = 0: later neighbours do not count yet.
template <class Real>
void TwoGridCycle::sweep_down(std::int32_t i, const Real* b, Real* x) const {
  Point<Real> y = scaled(b, i);
  subtract(&links_[rows_[i].links], &links_[rows_[i].later], x, y);
  y.store(x + 3 * std::size_t(i));
}

/// The equation held when the sweep was here; only later neighbours have moved since.
template <class Real>
void TwoGridCycle::restrict_residual(std::int32_t i, const Real* x, Real* coarse) const {
  auto residual = Point<Real>::zero();  // over a_ii
  subtract(&links_[rows_[i].later], &links_[rows_[i + 1].links], x, residual);
  const float diagonal = 1.0f / inverse_diagonal_[i];
  for (std::int32_t k = rows_[i].parents; k < rows_[i + 1].parents; ++k) {
    Real* entries = coarse + 3 * std::size_t(parents_[k].vertex);
    auto sum = Point<Real>::at(entries);
    sum.subtract(-diagonal * parents_[k].weight, residual);
    sum.store(entries);
  }
}

template <class Real>
void TwoGridCycle::prolong(std::int32_t i, const Real* coarse, Real* x) const {
  auto y = Point<Real>::at(x + 3 * std::size_t(i));
  for (std::int32_t k = rows_[i].parents; k < rows_[i + 1].parents; ++k)
    y.subtract(-parents_[k].weight, Point<Real>::at(coarse + 3 * std::size_t(parents_[k].vertex)));
  y.store(x + 3 * std::size_t(i));
}

template <class Real>
Sum<Real> TwoGridCycle::sweep_up(std::int32_t i, const Real* b, Real* x, Real* solution) const {
  Point<Real> y = scaled(b, i);
  subtract(&links_[rows_[i].links], &links_[rows_[i + 1].links], x, y);
  const std::size_t at = 3 * std::size_t(i);
  y.store(x + at);
  Real product(0);  // of one vertex: it may be added in the precision of the entries
  for (int c = 0; c < 3; ++c) product += b[at + c] * x[at + c];
  y.store(solution + at);  // perhaps b's place
  return widened(product);
}

// The two parts of a leg follow each other through the mesh, at the distance of a front of its
// numbering: a vertex is still in a cache when the second comes to it.

template <class Real>
void TwoGridCycle::descend(const Real* b, Real* x, Real* coarse) const {
  const auto n = static_cast<std::int32_t>(size());
  for (std::int32_t swept = 0, restricted = 0; restricted < n;) {
    for (const std::int32_t end = std::min(n, swept + kRows); swept < end; ++swept)
      sweep_down(swept, b, x);
    for (; restricted < n && last_[restricted] < swept; ++restricted)
      restrict_residual(restricted, x, coarse);
  }
}

template <class Real>
Sum<Real> TwoGridCycle::ascend(const Real* coarse, const Real* b, Real* x, Real* solution) const {
  Sum<Real> product(0.0);
  for (auto swept = static_cast<std::int32_t>(size()), prolonged = swept; swept > 0;) {
    for (const std::int32_t end = std::max(0, prolonged - kRows); prolonged > end;)
      prolong(--prolonged, coarse, x);
    while (swept > 0 && first_[swept - 1] >= prolonged)
      product += sweep_up(--swept, b, x, solution);
  }
  return product;
}

template <class Real>
Sum<Real> TwoGridCycle::apply(const Real* right_hand_side, Real* solution, Scratch& scratch) const {
  Real* x = scratch.array<Real>(3 * (size() + coarse_size()));
  Real* coarse = x + 3 * size();
  std::fill_n(coarse, 3 * coarse_size(), Real(0));
  descend(right_hand_side, x, coarse);
  coarse_.solve(coarse, coarse);
  return ascend(coarse, right_hand_side, x, solution);
}

}  // namespace snapspace
