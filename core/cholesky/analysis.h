#pragma once
#include <Eigen/SparseCore>

#include "cholesky/supernodes.h"

namespace snapspace {

/// The supernodes of A in the order with the fewest non-zeros that is worth its time: minimum
/// degree, and nested dissection as well where that leaves a dense factor. Both triangles of A and
/// its diagonal are stored; only the pattern is read.
[[nodiscard]] Supernodes analysed(const Eigen::SparseMatrix<double>& A);

}  // namespace snapspace
