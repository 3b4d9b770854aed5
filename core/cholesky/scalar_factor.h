#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cholesky/supernodes.h"
#include "memory/prefetch.h"
#include "memory/streamed_vector.h"
#include "simd/packs.h"

namespace snapspace {

/// Cholesky factor of a scalar n x n matrix, applied to x, y, z (and to all lanes) at once.
///
/// A 3n x 3n system A (x) I is solved with the factor of A: a ninth of the work of a full
/// elasticity factor, and with one sample per lane the factor is read once for all lanes.
/// It is stored as L D L^T with a unit diagonal, in blocks of up to kColumnBlock columns of a
/// supernode. The unknowns of a block stay in registers while a solve passes over the rows below:
/// an entry costs three products, and a row is loaded and stored once for all columns of the block.
class ScalarFactor {
 public:
  /// @param A  symmetric positive definite, both triangles and the diagonal stored
  /// @throws std::invalid_argument if A is not positive definite
  explicit ScalarFactor(const Eigen::SparseMatrix<double>& A);

  /// The same with known supernodes: those of A, or of a matrix whose pattern contains A's.
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
    std::int64_t values;    // first of D^-1, followed by the triangle and the rows below
    std::int64_t vertices;  // first of the columns, followed by the rows below
    std::int32_t columns, below;
  };

  void add_panel(const Eigen::MatrixXd& panel);

  /// One block's part of the solve with L, and of the solve with D and L^T; `all` is 3n. `backward`
  /// finds the block's part of w in `all`, and returns that of w . D^-1 w.
  template <int Columns, class Real>
  static void forward(const Block& block, const Scalar<Real>* l, const std::int32_t* vertices,
                      Real* all);
  template <int Columns, class Real>
  static Sum<Real> backward(const Block& block, const Scalar<Real>* l, const std::int32_t* vertices,
                            Real* all);

  /// Rows below a block are scattered over a large vector, so they are prefetched a few rows early.
  static constexpr int kRowsAhead = 6;
  /// The columns of blocks likewise, a few blocks early. The backward solve prefetches the entries
  /// too: processors look ahead within a panel, but not to the panel before it.
  static constexpr int kBlocksAhead = 2;

  template <class Real>
  [[gnu::always_inline]] inline static void prefetch_row(const Real* all, const std::int32_t* rows,
                                                         int row, int count) {
    if (row + kRowsAhead < count) prefetch(all + 3 * std::size_t(rows[row + kRowsAhead]), 3);
  }
  template <class Real>
  void prefetch_columns(const Block& block, const Real* all) const {
    for (int j = 0; j < block.columns; ++j)
      prefetch(all + 3 * std::size_t(vertices_[block.vertices + j]), 3);
  }

  std::vector<Block> blocks_;
  std::vector<std::int32_t> vertices_;  // supernode by supernode
  StreamedVector<double> values_;
  StreamedVector<float> single_values_;  // the same, for right-hand sides in single precision
  std::size_t size_ = 0;
};

#define SNAPSPACE_DECLARED(Real) \
  extern template Sum<Real> ScalarFactor::solve(const Real*, Real*) const;
SNAPSPACE_PACKS(SNAPSPACE_DECLARED)
#undef SNAPSPACE_DECLARED

}  // namespace snapspace
