#pragma once
#include <cmath>
#include <cstddef>

namespace snapspace::online {

/// Replaces a symmetric positive definite d x d matrix (lower triangle read) by its inverse,
/// through its Cholesky factor. Returns false, and leaves the matrix undefined, if it is not
/// positive definite.
/// @param inverse  work array of d x d numbers
inline bool invert_spd(double* matrix, int d, double* inverse) {
  const auto at = [&](int i, int j) -> double& {
    return matrix[static_cast<std::size_t>(i) * d + j];
  };
  for (int j = 0; j < d; ++j) {  // lower factor in place
    for (int k = 0; k < j; ++k) at(j, j) -= at(j, k) * at(j, k);
    if (!(at(j, j) > 0.0)) return false;
    at(j, j) = std::sqrt(at(j, j));
    for (int i = j + 1; i < d; ++i) {
      for (int k = 0; k < j; ++k) at(i, j) -= at(i, k) * at(j, k);
      at(i, j) /= at(j, j);
    }
  }
  for (int j = 0; j < d; ++j) {  // inverse of the factor, lower triangle
    inverse[static_cast<std::size_t>(j) * d + j] = 1.0 / at(j, j);
    for (int i = j + 1; i < d; ++i) {
      double sum = 0.0;
      for (int k = j; k < i; ++k) sum -= at(i, k) * inverse[static_cast<std::size_t>(k) * d + j];
      inverse[static_cast<std::size_t>(i) * d + j] = sum / at(i, i);
    }
  }
  for (int i = 0; i < d; ++i)
    for (int j = 0; j <= i; ++j) {
      double sum = 0.0;
      for (int k = i; k < d; ++k)
        sum += inverse[static_cast<std::size_t>(k) * d + i] *
               inverse[static_cast<std::size_t>(k) * d + j];
      at(i, j) = at(j, i) = sum;
    }
  return true;
}

}  // namespace snapspace::online
