#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace snapspace {

/// A partition of the unknowns of a matrix into small connected sets. Each set becomes an unknown
/// of a coarser grid.
struct Aggregates {
  std::vector<std::int32_t> of;  ///< the aggregate of every unknown
  std::int32_t count = 0;        ///< in the order of their first unknowns
};

/// Aggregates are unknowns with all their neighbours, where these do not overlap; the unknowns in
/// between join a neighbouring aggregate (Vanek, Mandel, Brezina 1996, sec. 5.1, with all
/// neighbours treated as strong).
/// @param A  both triangles stored; only the pattern is read
[[nodiscard]] Aggregates aggregated(const Eigen::SparseMatrix<double>& A);

}  // namespace snapspace
