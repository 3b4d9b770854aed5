#pragma once
#include <vector>

#include "dense/square_matrix.h"

namespace snapspace {

/// The lowest pairs of a symmetric pencil (H, A): H c = value A c.
struct PencilPairs {
  std::vector<double> values;        ///< ascending; empty where A is not positive definite
  std::vector<double> coefficients;  ///< (columns of the pencil) x pairs, A-orthonormal
};

/// Solves on the leading `columns` rows and columns; only lower triangles are read. There are no
/// pairs if these columns are dependent: if A, scaled to a unit diagonal, has a pivot with a root
/// below `least_pivot`.
[[nodiscard]] PencilPairs lowest_pairs(const SquareMatrix& hessian, const SquareMatrix& scalar,
                                       int columns, int pairs, double least_pivot);

/// B^T M B of a symmetric M, given by its lower triangle; B has as many rows as M.
[[nodiscard]] SquareMatrix congruent(const SquareMatrix& M, const std::vector<double>& B);

}  // namespace snapspace
