#pragma once
#include <cstddef>
#include <vector>

namespace snapspace {

/// A square matrix, column by column.
struct SquareMatrix {
  int size = 0;
  std::vector<double> entries;

  explicit SquareMatrix(int n = 0) : size(n), entries(static_cast<std::size_t>(n) * n, 0.0) {}
  double& operator()(int row, int column) { return entries[row + column * std::size_t(size)]; }
  double operator()(int row, int column) const { return entries[row + column * std::size_t(size)]; }
};

}  // namespace snapspace
