#pragma once
#include <vector>

#include "dense/square_matrix.h"

namespace snapspace {

/// Eigenvalues, ascending, and orthonormal eigenvectors as columns.
struct EigenPairs {
  std::vector<double> values;
  SquareMatrix vectors;
};

/// The eigenpairs of a symmetric matrix, given by its lower triangle, by Jacobi's method (Golub &
/// Van Loan 2013, sec. 8.5): short, accurate, and fast enough for a few dozen columns.
[[nodiscard]] EigenPairs symmetric_eigen(SquareMatrix A);

}  // namespace snapspace
