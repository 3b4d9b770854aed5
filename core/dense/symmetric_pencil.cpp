#include "dense/symmetric_pencil.h"

#include <cmath>
#include <utility>

#include "dense/symmetric_eigen.h"

namespace snapspace {

namespace {

/// Replaces M by its Cholesky factor, in the lower triangle. Returns false if the root of a pivot
/// is below `least_pivot`.
bool factorize(SquareMatrix& M, double least_pivot) {
  for (int j = 0; j < M.size; ++j) {
    const double root = std::sqrt(M(j, j));
    if (!(root >= least_pivot)) return false;
    M(j, j) = root;
    for (int i = j + 1; i < M.size; ++i) M(i, j) /= root;
    for (int k = j + 1; k < M.size; ++k)
      for (int i = k; i < M.size; ++i) M(i, k) -= M(i, j) * M(k, j);
  }
  return true;
}

/// Both triangles of the leading part of M, with rows and columns times `scales`.
SquareMatrix scaled(const SquareMatrix& M, const std::vector<double>& scales) {
  SquareMatrix result(static_cast<int>(scales.size()));
  for (int j = 0; j < result.size; ++j)
    for (int i = j; i < result.size; ++i)
      result(i, j) = result(j, i) = M(i, j) * scales[i] * scales[j];
  return result;
}

/// x = L^-1 x and x = L^-T x for a lower triangle L.
void solve_lower(const SquareMatrix& L, double* x) {
  for (int j = 0; j < L.size; ++j) {
    x[j] /= L(j, j);
    for (int i = j + 1; i < L.size; ++i) x[i] -= L(i, j) * x[j];
  }
}
void solve_upper(const SquareMatrix& L, double* x) {
  for (int j = L.size - 1; j >= 0; --j) {
    for (int i = j + 1; i < L.size; ++i) x[j] -= L(i, j) * x[i];
    x[j] /= L(j, j);
  }
}

/// L^-1 H L^-T
SquareMatrix reduced(SquareMatrix H, const SquareMatrix& L) {
  const auto solve_columns = [&] {
    for (int j = 0; j < H.size; ++j) solve_lower(L, &H(0, j));
  };
  solve_columns();
  for (int j = 0; j < H.size; ++j)
    for (int i = 0; i < j; ++i) std::swap(H(i, j), H(j, i));
  solve_columns();
  return H;
}

}  // namespace

PencilPairs lowest_pairs(const SquareMatrix& hessian, const SquareMatrix& scalar, int columns,
                         int pairs, double least_pivot) {
  std::vector<double> scales;
  for (int i = 0; i < columns; ++i) {
    if (!(scalar(i, i) > 0.0)) return {};
    scales.push_back(1.0 / std::sqrt(scalar(i, i)));
  }
  SquareMatrix factor = scaled(scalar, scales);
  if (!factorize(factor, least_pivot)) return {};
  EigenPairs eigen = symmetric_eigen(reduced(scaled(hessian, scales), factor));
  PencilPairs result;
  result.values.assign(eigen.values.begin(), eigen.values.begin() + pairs);
  for (int k = 0; k < pairs; ++k) {
    solve_upper(factor, &eigen.vectors(0, k));
    for (int i = 0; i < columns; ++i)
      result.coefficients.push_back(scales[i] * eigen.vectors(i, k));
  }
  return result;
}

SquareMatrix congruent(const SquareMatrix& M, const std::vector<double>& B) {
  const int n = M.size, columns = static_cast<int>(B.size() / n);
  SquareMatrix result(columns);
  std::vector<double> product(n);  // M times a column of B
  for (int c = 0; c < columns; ++c) {
    const double* b = &B[c * std::size_t(n)];
    for (int i = 0; i < n; ++i) {
      product[i] = 0.0;
      for (int j = 0; j < n; ++j) product[i] += (i < j ? M(j, i) : M(i, j)) * b[j];
    }
    for (int r = 0; r < columns; ++r)
      for (int i = 0; i < n; ++i) result(r, c) += B[r * std::size_t(n) + i] * product[i];
  }
  return result;
}

}  // namespace snapspace
