#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cholesky/point.h"
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
  /// So do the columns of blocks, a few blocks early. On the way back the entries are asked for as
  /// well: processors look ahead within a panel, but not to the one before it.
  static constexpr int kBlocksAhead = 2;

  /// Compilers drop the call of a function that does nothing else, unless they must inline it.
  template <class T>
  [[gnu::always_inline]] inline static void ask_for([[maybe_unused]] const T* begin,
                                                    [[maybe_unused]] std::size_t count) {
#if defined(__GNUC__)
    const auto* bytes = reinterpret_cast<const char*>(begin);
    for (std::size_t at = 0; at < count * sizeof(T); at += 64) __builtin_prefetch(bytes + at);
#endif
  }
  template <class Real>
  [[gnu::always_inline]] inline static void ask_for_row(const Real* all, const std::int32_t* rows,
                                                        int row, int count) {
    if (row + kRowsAhead < count) ask_for(all + 3 * std::size_t(rows[row + kRowsAhead]), 3);
  }
  template <class Real>
  void ask_for_columns(const Block& block, const Real* all) const {
    for (int j = 0; j < block.columns; ++j)
      ask_for(all + 3 * std::size_t(vertices_[block.vertices + j]), 3);
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

// The loops over columns are unrolled: otherwise the unknowns are kept in memory and not in
// registers, and small blocks take longer for their triangles than for the rows below.

template <int Columns, class Real>
void ScalarFactor::forward(const Block& block, const Scalar<Real>* l, const std::int32_t* vertices,
                           Real* all) {
  const auto entries_of = [&](std::int32_t vertex) { return all + 3 * std::size_t(vertex); };
  Point<Real> x[Columns];
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) x[j] = Point<Real>::at(entries_of(vertices[j]));
  l += Columns;
#pragma GCC unroll 8
  for (int j = 1; j < Columns; ++j)
#pragma GCC unroll 8
    for (int i = 0; i < j; ++i) x[j].subtract(l[j * (j - 1) / 2 + i], x[i]);
  l += Columns * (Columns - 1) / 2;
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) x[j].store(entries_of(vertices[j]));
  vertices += Columns;
  for (int row = 0; row < block.below; ++row, l += Columns) {
    ask_for_row(all, vertices, row, block.below);
    Real* entries = entries_of(vertices[row]);
    Point<Real> y = Point<Real>::at(entries);
    if constexpr (Columns > 4) {
      // two sums: a product is ready four cycles after it has begun, and two begin in each
      Point<Real> odd = Point<Real>::zero();
#pragma GCC unroll 8
      for (int j = 0; j < Columns; ++j) (j % 2 ? odd : y).subtract(l[j], x[j]);
      y.add(odd);
    } else {
#pragma GCC unroll 8
      for (int j = 0; j < Columns; ++j) y.subtract(l[j], x[j]);
    }
    y.store(entries);
  }
}

template <int Columns, class Real>
Sum<Real> ScalarFactor::backward(const Block& block, const Scalar<Real>* l,
                                 const std::int32_t* vertices, Real* all) {
  const auto entries_of = [&](std::int32_t vertex) { return all + 3 * std::size_t(vertex); };
  Point<Real> x[Columns];
  Real product(0);  // of a few vertices: it may be added in the precision of the entries
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) {
    Real* entries = entries_of(vertices[j]);
    for (int c = 0; c < 3; ++c) {
      const Real w = entries[c];
      entries[c] = Real(l[j]) * w;
      product += w * entries[c];
    }
    x[j] = Point<Real>::at(entries);
  }
  l += Columns;
  const Scalar<Real>* row_entries = l + Columns * (Columns - 1) / 2;
  for (int row = 0; row < block.below; ++row, row_entries += Columns) {
    ask_for_row(all, vertices + Columns, row, block.below);
    const auto y = Point<Real>::at(entries_of(vertices[Columns + row]));
#pragma GCC unroll 8
    for (int j = 0; j < Columns; ++j) x[j].subtract(row_entries[j], y);
  }
#pragma GCC unroll 8
  for (int j = Columns - 1; j > 0; --j)
#pragma GCC unroll 8
    for (int i = 0; i < j; ++i) x[i].subtract(l[j * (j - 1) / 2 + i], x[j]);
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) x[j].store(entries_of(vertices[j]));
  return widened(product);
}

template <class Real>
Sum<Real> ScalarFactor::solve(const Real* right_hand_side, Real* solution) const {
  if (solution != right_hand_side) std::copy_n(right_hand_side, 3 * size_, solution);
  const Scalar<Real>* values = entries<Real>();
  const auto count = static_cast<std::ptrdiff_t>(blocks_.size());
  for (std::ptrdiff_t b = 0; b < count; ++b) {
    if (b + kBlocksAhead < count) ask_for_columns(blocks_[b + kBlocksAhead], solution);
    const Block& block = blocks_[b];
    with_columns(block.columns, [&](auto columns) {
      forward<columns()>(block, values + block.values, vertices_.data() + block.vertices, solution);
    });
  }
  Sum<Real> product(0.0);
  for (std::ptrdiff_t b = count - 1; b >= 0; --b) {
    if (b >= kBlocksAhead) {
      const Block& soon = blocks_[b - kBlocksAhead];
      ask_for_columns(soon, solution);
      ask_for(vertices_.data() + soon.vertices,
              static_cast<std::size_t>(soon.columns + soon.below));
      ask_for(values + soon.values, static_cast<std::size_t>((&soon)[1].values - soon.values));
    }
    const Block& block = blocks_[b];
    with_columns(block.columns, [&](auto columns) {
      product += backward<columns()>(block, values + block.values,
                                     vertices_.data() + block.vertices, solution);
    });
  }
  return product;
}

}  // namespace snapspace
