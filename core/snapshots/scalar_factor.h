#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cholesky/supernodes.h"
#include "memory/streamed_vector.h"
#include "simd/lanes.h"

namespace snapspace {

/// Cholesky factor of a scalar n x n matrix, applied to x, y, z (and to all lanes) at once.
///
/// A 3n x 3n system A (x) I is solved with the factor of A: a ninth of the work of a full
/// elasticity factor, and with one sample per lane the factor is read once for all lanes.
///
/// It is kept as L D L^T with a unit diagonal, in blocks of up to kColumnBlock columns of a
/// supernode. The unknowns of a block stay in registers while the rows below pass by: an entry
/// costs three products, and a row is loaded and stored once for all columns of the block.
class ScalarFactor {
 public:
  /// @param A  symmetric positive definite, both triangles and the diagonal stored
  /// @throws std::invalid_argument if A is not positive definite
  explicit ScalarFactor(const Eigen::SparseMatrix<double>& A);

  /// The same for supernodes that are known: of A, or of a matrix whose pattern contains A's.
  ScalarFactor(const Eigen::SparseMatrix<double>& A, const Supernodes& supernodes);

  [[nodiscard]] std::size_t size() const { return size_; }
  /// Entries of the factor, with the explicit zeros of its supernodes.
  [[nodiscard]] std::size_t nonzeros() const { return values_.size(); }

  /// solution = (A (x) I3)^{-1} right_hand_side, both 3n; they may be the same array.
  /// @return  right_hand_side . solution
  template <class Real>
  Sum<Real> solve(const Real* right_hand_side, Real* solution) const;

 private:
  template <class Real>
  using Scalar = typename ScalarOf<Real>::type;

  template <class Real>
  const Scalar<Real>* entries() const {
    if constexpr (std::is_same_v<Scalar<Real>, float>)
      return single_values_.data();
    else
      return values_.data();
  }

  struct Block {
    std::int64_t values;    // where those of D^-1 begin; then the triangle, then the rows below
    std::int64_t vertices;  // where those of the columns begin; then those of the rows below
    std::int32_t columns, below;
  };

  void add_panel(const Eigen::MatrixXd& panel);

  /// One block's part of the solve with L, and of that with D and L^T; `all` is 3n. The second
  /// returns the block's part of w . D^-1 w with the w that it finds.
  template <int Columns, class Real>
  static void forward(const Block& block, const Scalar<Real>* l, const std::int32_t* vertices,
                      Real* all);
  template <int Columns, class Real>
  static Sum<Real> backward(const Block& block, const Scalar<Real>* l, const std::int32_t* vertices,
                            Real* all);

  /// Rows below a block lie anywhere in a large vector: they are asked for a few rows early.
  static constexpr int kRowsAhead = 6;
  template <class Real>
  static void ask_for(const Real* all, const std::int32_t* rows, int row, int count) {
#if defined(__GNUC__)
    if (row + kRowsAhead >= count) return;
    const auto* at = reinterpret_cast<const char*>(all + 3 * std::size_t(rows[row + kRowsAhead]));
    for (std::size_t byte = 0; byte < 3 * sizeof(Real); byte += 64)
      __builtin_prefetch(at + byte, 1);
#endif
  }

  /// Calls visit with the number of columns as a constant.
  template <int Most = kColumnBlock, class Visit>
  static void with_columns(int columns, Visit visit) {
    if constexpr (Most > 1)
      if (columns < Most) return with_columns<Most - 1>(columns, visit);
    visit(std::integral_constant<int, Most>{});
  }

  std::vector<Block> blocks_;
  std::vector<std::int32_t> vertices_;  // supernode by supernode
  StreamedVector<double> values_;
  StreamedVector<float> single_values_;  // the same, for right-hand sides in single precision
  std::size_t size_ = 0;
};

template <int Columns, class Real>
void ScalarFactor::forward(const Block& block, const Scalar<Real>* l, const std::int32_t* vertices,
                           Real* all) {
  Real x[Columns][3];
  for (int j = 0; j < Columns; ++j)
    for (int c = 0; c < 3; ++c) x[j][c] = all[3 * static_cast<std::size_t>(vertices[j]) + c];
  l += Columns;
  for (int j = 1; j < Columns; ++j)
    for (int i = 0; i < j; ++i, ++l)
      for (int c = 0; c < 3; ++c) x[j][c] -= Real(*l) * x[i][c];
  for (int j = 0; j < Columns; ++j)
    for (int c = 0; c < 3; ++c) all[3 * static_cast<std::size_t>(vertices[j]) + c] = x[j][c];
  vertices += Columns;
  for (int row = 0; row < block.below; ++row, l += Columns) {
    ask_for(all, vertices, row, block.below);
    Real* y = all + 3 * static_cast<std::size_t>(vertices[row]);
    Real y0 = y[0], y1 = y[1], y2 = y[2];
    for (int j = 0; j < Columns; ++j) {
      const Real entry(l[j]);
      y0 -= entry * x[j][0];
      y1 -= entry * x[j][1];
      y2 -= entry * x[j][2];
    }
    y[0] = y0;
    y[1] = y1;
    y[2] = y2;
  }
}

template <int Columns, class Real>
Sum<Real> ScalarFactor::backward(const Block& block, const Scalar<Real>* l,
                                 const std::int32_t* vertices, Real* all) {
  Real x[Columns][3];
  Sum<Real> product(0.0);
  for (int j = 0; j < Columns; ++j)
    for (int c = 0; c < 3; ++c) {
      const Real w = all[3 * static_cast<std::size_t>(vertices[j]) + c];
      x[j][c] = Real(l[j]) * w;
      product += widened(w) * widened(x[j][c]);
    }
  l += Columns * (Columns + 1) / 2;
  const Scalar<Real>* entries = l;
  for (int row = 0; row < block.below; ++row, entries += Columns) {
    ask_for(all, vertices + Columns, row, block.below);
    const Real* y = all + 3 * static_cast<std::size_t>(vertices[Columns + row]);
    const Real y0 = y[0], y1 = y[1], y2 = y[2];
    for (int j = 0; j < Columns; ++j) {
      const Real entry(entries[j]);
      x[j][0] -= entry * y0;
      x[j][1] -= entry * y1;
      x[j][2] -= entry * y2;
    }
  }
  for (int j = Columns - 1; j > 0; --j) {
    l -= j;
    for (int i = 0; i < j; ++i)
      for (int c = 0; c < 3; ++c) x[i][c] -= Real(l[i]) * x[j][c];
  }
  for (int j = 0; j < Columns; ++j)
    for (int c = 0; c < 3; ++c) all[3 * static_cast<std::size_t>(vertices[j]) + c] = x[j][c];
  return product;
}

template <class Real>
Sum<Real> ScalarFactor::solve(const Real* right_hand_side, Real* solution) const {
  if (solution != right_hand_side) std::copy_n(right_hand_side, 3 * size_, solution);
  const Scalar<Real>* values = entries<Real>();
  for (auto block = blocks_.begin(); block != blocks_.end(); ++block)
    with_columns(block->columns, [&](auto columns) {
      forward<columns()>(*block, values + block->values, vertices_.data() + block->vertices,
                         solution);
    });
  Sum<Real> product(0.0);
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block)
    with_columns(block->columns, [&](auto columns) {
      product += backward<columns()>(*block, values + block->values,
                                     vertices_.data() + block->vertices, solution);
    });
  return product;
}

}  // namespace snapspace
