#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <span>
#include <vector>

namespace snapspace {

/// Number of columns that a solve of this level processes together.
[[nodiscard]] int column_block();

/// The non-zero pattern of a Cholesky factor: runs of columns with the same rows below them, each a
/// dense panel. Columns and rows are numbered in elimination order.
struct Supernodes {
  std::vector<std::int32_t> order;            ///< vertex of every column
  std::vector<std::int32_t> first_column{0};  ///< for each supernode; count() + 1 entries
  std::vector<std::int64_t> first_row{0};     ///< for each supernode in `rows`; count() + 1 entries
  std::vector<std::int32_t> rows;             ///< below the supernode's own columns, ascending
  std::vector<std::int32_t> parent;           ///< the supernode of the first row; -1 for a root

  /// Children come before their parents, and subtrees are contiguous.
  ///
  /// @param A      both triangles; only the pattern is read
  /// @param order  vertices in the order of elimination. Supernodes keep its fill-in, and add a few
  ///               explicit zeros where that makes them larger and solves faster.
  Supernodes(const Eigen::SparseMatrix<double>& A, const std::vector<std::int32_t>& order);

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(parent.size()); }
  [[nodiscard]] std::int32_t columns(std::int32_t s) const {
    return first_column[s + 1] - first_column[s];
  }
  [[nodiscard]] std::span<const std::int32_t> below(std::int32_t s) const {
    return {rows.data() + first_row[s], rows.data() + first_row[s + 1]};
  }
  /// Entries of the factor, with the explicit zeros.
  [[nodiscard]] std::int64_t entries() const;
  /// The place of every vertex among the columns.
  [[nodiscard]] std::vector<std::int32_t> places() const;
};

}  // namespace snapspace
