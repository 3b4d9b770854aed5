#include "multigrid/two_grid_cycle.h"

#include "multigrid/aggregates.h"

namespace snapspace {

namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The largest eigenvalue of D^-1 A, a little from below, by the power method.
double largest_eigenvalue(const Matrix& A, const Eigen::VectorXd& inverse_diagonal) {
  constexpr int kSteps = 15;
  Eigen::VectorXd v(A.cols());
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = static_cast<double>(i * 7919 % 101) - 50.0;
  for (int step = 0; step < kSteps; ++step) {
    v.normalize();
    v = inverse_diagonal.cwiseProduct(A * v).eval();
  }
  return v.norm();
}

/// Constants on aggregates, smoothed by a step of Jacobi's method with the usual damping.
Rows prolongation_of(const Matrix& A) {
  const Aggregates aggregates = aggregated(A);
  Rows constants(A.rows(), aggregates.count);
  constants.reserve(Eigen::VectorXi::Ones(A.rows()));
  for (Eigen::Index i = 0; i < A.rows(); ++i) constants.insert(i, aggregates.of[i]) = 1.0;
  const Eigen::VectorXd inverse = A.diagonal().cwiseInverse();
  const double damping = 4.0 / 3.0 / largest_eigenvalue(A, inverse);
  const Rows smoother = (damping * inverse).asDiagonal() * Rows(A);
  return constants - Rows(smoother * constants);
}

Matrix coarsened(const Matrix& A, const Matrix& prolongation) {
  return prolongation.transpose() * Matrix(A * prolongation);
}

}  // namespace

TwoGridCycle::TwoGridCycle(const Matrix& A) : TwoGridCycle(A, prolongation_of(A)) {}

TwoGridCycle::TwoGridCycle(const Matrix& A, const Rows& prolongation)
    : coarse_(coarsened(A, prolongation)) {
  const auto n = static_cast<std::int32_t>(A.cols());
  inverse_diagonal_.reserve(n);
  rows_.reserve(n + 1);
  links_.reserve(A.nonZeros() - n);
  parents_.reserve(prolongation.nonZeros());
  for (std::int32_t i = 0; i < n; ++i) add_row(A, prolongation, i);
  const auto links = static_cast<std::int32_t>(links_.size());
  rows_.push_back({links, links, static_cast<std::int32_t>(parents_.size())});
  for (std::int32_t i = 1; i < n; ++i) last_[i] = std::max(last_[i], last_[i - 1]);
  for (std::int32_t i = n - 1; i > 0; --i) first_[i - 1] = std::min(first_[i], first_[i - 1]);
}

void TwoGridCycle::add_row(const Matrix& A, const Rows& prolongation, std::int32_t i) {
  const double inverse = 1.0 / A.coeff(i, i);
  inverse_diagonal_.push_back(static_cast<float>(inverse));
  const auto begin = static_cast<std::int32_t>(links_.size());
  Row row{begin, begin, static_cast<std::int32_t>(parents_.size())};
  first_.push_back(i);
  last_.push_back(i);
  for (Matrix::InnerIterator entry(A, i); entry; ++entry) {
    const auto j = static_cast<std::int32_t>(entry.row());
    if (j == i) continue;
    links_.push_back({j, static_cast<float>(entry.value() * inverse)});
    if (j < i) row.later = static_cast<std::int32_t>(links_.size());
    first_.back() = std::min(first_.back(), j);
    last_.back() = std::max(last_.back(), j);
  }
  for (Rows::InnerIterator entry(prolongation, i); entry; ++entry)
    parents_.push_back({static_cast<std::int32_t>(entry.col()), static_cast<float>(entry.value())});
  rows_.push_back(row);
}

}  // namespace snapspace
