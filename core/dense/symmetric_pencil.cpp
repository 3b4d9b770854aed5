#include "dense/symmetric_pencil.h"

#include <Eigen/Eigenvalues>

namespace snapspace {

namespace {

using Matrix = Eigen::MatrixXd;

Eigen::Map<const Matrix> mapped(const SquareMatrix& M) {
  return {M.entries.data(), M.size, M.size};
}

}  // namespace

PencilPairs lowest_pairs(const SquareMatrix& hessian, const SquareMatrix& scalar, int columns,
                         int pairs, double least_pivot) {
  const Eigen::VectorXd lengths = mapped(scalar).diagonal().head(columns).cwiseSqrt();
  if (!(lengths.minCoeff() > 0.0)) return {};
  const auto inverse = lengths.cwiseInverse().asDiagonal();
  const Matrix A = inverse * mapped(scalar).topLeftCorner(columns, columns) * inverse;
  const Matrix H = inverse * mapped(hessian).topLeftCorner(columns, columns) * inverse;
  const Eigen::LLT<Matrix> factor(A);  // of the lower triangle, as everything here
  if (factor.info() != Eigen::Success || factor.matrixLLT().diagonal().minCoeff() < least_pivot)
    return {};
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(H, A);
  PencilPairs result;
  result.values.assign(solver.eigenvalues().data(), solver.eigenvalues().data() + pairs);
  const Matrix coefficients = inverse * solver.eigenvectors().leftCols(pairs);
  result.coefficients.assign(coefficients.data(), coefficients.data() + coefficients.size());
  return result;
}

SquareMatrix congruent(const SquareMatrix& M, const std::vector<double>& B) {
  const auto columns = static_cast<int>(B.size() / M.size);
  const Eigen::Map<const Matrix> b(B.data(), M.size, columns);
  SquareMatrix result(columns);
  Eigen::Map<Matrix>(result.entries.data(), columns, columns) =
      b.transpose() * (mapped(M).selfadjointView<Eigen::Lower>() * b);
  return result;
}

}  // namespace snapspace
