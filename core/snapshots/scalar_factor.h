#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cholesky/supernodes.h"
#include "simd/lanes.h"

namespace snapspace {

/// Cholesky factor of a scalar n x n matrix, applied to x, y, z (and to all lanes) at once.
///
/// A 3n x 3n system A (x) I is solved with the factor of A: a ninth of the work of a full
/// elasticity factor, and with one sample per lane the factor is read once for all lanes.
class ScalarFactor {
 public:
  /// @param A  symmetric positive definite, both triangles stored
  /// @throws std::invalid_argument if A is not positive definite
  explicit ScalarFactor(const Eigen::SparseMatrix<double>& A);

  ScalarFactor(const Eigen::SparseMatrix<double>& A, const Supernodes& supernodes);

  /// Of the factor, with the explicit zeros of its supernodes.
  [[nodiscard]] std::size_t nonzeros() const { return values_.size(); }

  /// solution = (A (x) I3)^{-1} right_hand_side, both 3n; they may be the same. `scratch` is 3n.
  template <class Real>
  void solve(const Real* right_hand_side, Real* solution, Real* scratch) const;

 private:
  template <class T>
  struct ScalarOf {
    using type = T;
  };
  template <class T, int Width>
  struct ScalarOf<Pack<T, Width>> {
    using type = T;
  };
  template <class Real>
  using Scalar = typename ScalarOf<Real>::type;

  template <class Real>
  const Scalar<Real>* entries() const {
    if constexpr (std::is_same_v<Scalar<Real>, float>)
      return single_values_.data();
    else
      return values_.data();
  }

  /// Columns whose unknowns are in registers while the rows below them pass by. An entry then costs
  /// three products, and a row is loaded and stored once for all columns of the block.
#if defined(__AVX512F__) || defined(__aarch64__)
  static constexpr int kBlock = 8;
#else
  static constexpr int kBlock = 4;
#endif
  struct Block {
    std::int64_t values;    // the triangle row by row, inverse diagonal last; then the rows below
    std::int64_t vertices;  // of the columns, then of the rows below
    std::int32_t columns, rows;
  };

  template <int Columns, class Real>
  static void forward(const Scalar<Real>* l, const std::int32_t* vertices, int rows, Real* all);
  template <int Columns, class Real>
  static void backward(const Scalar<Real>* l, const std::int32_t* vertices, int rows, Real* all);

  template <class Visit>
  static void with_columns(int columns, Visit visit) {
    switch (columns) {
      case 1:
        return visit(std::integral_constant<int, 1>{});
      case 2:
        return visit(std::integral_constant<int, 2>{});
      case 3:
        return visit(std::integral_constant<int, 3>{});
      case 4:
        return visit(std::integral_constant<int, 4>{});
      case 5:
        return visit(std::integral_constant<int, 5>{});
      case 6:
        return visit(std::integral_constant<int, 6>{});
      case 7:
        return visit(std::integral_constant<int, 7>{});
      default:
        return visit(std::integral_constant<int, 8>{});
    }
  }

  std::int32_t size_ = 0;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> vertices_;
  std::vector<double> values_;
  std::vector<float> single_values_;  // the same, for right-hand sides in single precision
};

template <int Columns, class Real>
void ScalarFactor::forward(const Scalar<Real>* l, const std::int32_t* vertices, int rows,
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
  for (int r = 0; r < rows; ++r, l += Columns) {
    Real* y = all + 3 * static_cast<std::size_t>(vertices[r]);
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
void ScalarFactor::backward(const Scalar<Real>* l, const std::int32_t* vertices, int rows,
                            Real* all) {
  constexpr int kTriangle = Columns * (Columns + 1) / 2;
  Real x[Columns][3];
  for (int j = 0; j < Columns; ++j)
    for (int c = 0; c < 3; ++c)
      x[j][c] = Real(l[j]) * all[3 * static_cast<std::size_t>(vertices[j]) + c];
  const Scalar<Real>* below = l + kTriangle;
  for (int r = 0; r < rows; ++r, below += Columns) {
    const Real* y = all + 3 * static_cast<std::size_t>(vertices[Columns + r]);
    const Real y0 = y[0], y1 = y[1], y2 = y[2];
    for (int j = 0; j < Columns; ++j) {
      const Real entry(below[j]);
      x[j][0] -= entry * y0;
      x[j][1] -= entry * y1;
      x[j][2] -= entry * y2;
    }
  }
  l += kTriangle;
  for (int j = Columns - 1; j > 0; --j) {
    l -= j;
    for (int i = 0; i < j; ++i)
      for (int c = 0; c < 3; ++c) x[i][c] -= Real(l[i]) * x[j][c];
  }
  for (int j = 0; j < Columns; ++j)
    for (int c = 0; c < 3; ++c) all[3 * static_cast<std::size_t>(vertices[j]) + c] = x[j][c];
}

template <class Real>
void ScalarFactor::solve(const Real* right_hand_side, Real* solution, Real*) const {
  if (solution != right_hand_side)
    std::copy_n(right_hand_side, 3 * static_cast<std::size_t>(size_), solution);
  const auto* values = entries<Real>();
  for (auto block = blocks_.begin(); block != blocks_.end(); ++block)
    with_columns(block->columns, [&](auto columns) {
      forward<columns()>(values + block->values, vertices_.data() + block->vertices, block->rows,
                         solution);
    });
  for (auto block = blocks_.rbegin(); block != blocks_.rend(); ++block)
    with_columns(block->columns, [&](auto columns) {
      backward<columns()>(values + block->values, vertices_.data() + block->vertices, block->rows,
                          solution);
    });
}

}  // namespace snapspace
