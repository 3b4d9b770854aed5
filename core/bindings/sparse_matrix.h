#pragma once
#include <Eigen/SparseCore>
#include <cstddef>

#include "bindings/arrays.h"

namespace snapspace {

/// A symmetric matrix (n, n) from Python, given by its columns with both triangles stored.
inline Eigen::SparseMatrix<double> sparse_matrix(IndexVectorIn starts, IndexVectorIn rows,
                                                 const double* values) {
  require(starts.size() >= 2 && starts.data()[0] == 0, "starts must be (n + 1,), from 0");
  const std::size_t n = starts.size() - 1;
  for (std::size_t j = 0; j < n; ++j)
    require(starts.data()[j] <= starts.data()[j + 1], "starts must not decrease");
  require(static_cast<std::size_t>(starts.data()[n]) == rows.size(), "one row per entry is needed");
  for (std::size_t i = 0; i < rows.size(); ++i)
    require(rows.data()[i] >= 0 && static_cast<std::size_t>(rows.data()[i]) < n,
            "a row is out of range");
  const auto size = static_cast<Eigen::Index>(n);
  return Eigen::Map<const Eigen::SparseMatrix<double>>(
      size, size, static_cast<Eigen::Index>(rows.size()), starts.data(), rows.data(), values);
}

inline Eigen::SparseMatrix<double> sparse_matrix(IndexVectorIn starts, IndexVectorIn rows,
                                                 VectorIn values) {
  require(rows.size() == values.size(), "one value per row is needed");
  return sparse_matrix(starts, rows, values.data());
}

}  // namespace snapspace
