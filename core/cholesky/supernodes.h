#pragma once
#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace snapspace {

/// Where the non-zeros of a Cholesky factor are: runs of columns with the same rows below them, so
/// that each is one dense panel. Columns and rows are numbered by elimination.
struct Supernodes {
  std::vector<std::int32_t> order;         ///< vertex of every column
  std::vector<std::int32_t> first_column;  ///< of each supernode; count + 1 entries
  std::vector<std::int64_t> first_row;     ///< of each in `rows`; count + 1 entries
  std::vector<std::int32_t> rows;          ///< below the supernode's own columns, ascending
  std::vector<std::int32_t> parent;        ///< the supernode of the first row; -1 for a root

  /// Children stand before their parents, and subtrees together.
  ///
  /// @param A      both triangles; only the pattern is read
  /// @param order  vertices as an ordering would eliminate them. Supernodes keep what it fills,
  ///               and add a few explicit zeros where that makes them larger and solves faster.
  Supernodes(const Eigen::SparseMatrix<double>& A, std::vector<std::int32_t> order);

  [[nodiscard]] std::int32_t count() const { return static_cast<std::int32_t>(parent.size()); }
  [[nodiscard]] std::int32_t columns(std::int32_t s) const {
    return first_column[s + 1] - first_column[s];
  }
  [[nodiscard]] std::int32_t rows_below(std::int32_t s) const {
    return static_cast<std::int32_t>(first_row[s + 1] - first_row[s]);
  }
  /// The place of every vertex among the columns.
  [[nodiscard]] std::vector<std::int32_t> places() const;
};

}  // namespace snapspace
