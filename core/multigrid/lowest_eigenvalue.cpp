#include "multigrid/lowest_eigenvalue.h"

#include <cmath>
#include <utility>
#include <vector>

#include "dense/symmetric_eigen.h"
#include "memory/scratch.h"
#include "multigrid/pseudo_random.h"

namespace snapspace {

namespace {

constexpr int kSteps = 16;

/// The cycle times a scalar vector: its entries are those of x, and y and z are zero.
Eigen::VectorXd applied(const TwoGridCycle& cycle, const Eigen::VectorXd& vector,
                        Scratch& scratch) {
  std::vector<double> points(3 * vector.size(), 0.0);
  for (Eigen::Index i = 0; i < vector.size(); ++i) points[3 * i] = vector[i];
  cycle.apply(points.data(), points.data(), scratch);
  return Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<3>>(points.data(), vector.size());
}

Eigen::VectorXd random_vector(Eigen::Index size) {
  Eigen::VectorXd vector(size);
  PseudoRandom next;
  for (double& entry : vector) entry = next();
  return vector;
}

}  // namespace

double lowest_eigenvalue(const Eigen::SparseMatrix<double>& A, const TwoGridCycle& cycle) {
  Scratch scratch;
  Eigen::VectorXd residual = random_vector(A.cols()), image = applied(cycle, residual, scratch);
  Eigen::VectorXd search = image;
  std::vector<double> diagonal, off_diagonal;  // Lanczos' tridiagonal matrix
  double norm = residual.dot(image), ratio = 0.0, step = 1.0;
  const double negligible = 1e-20 * norm;
  while (static_cast<int>(diagonal.size()) < kSteps && norm > negligible) {
    const Eigen::VectorXd product = A * search;
    const double before = ratio / step;
    step = norm / search.dot(product);
    if (!diagonal.empty()) off_diagonal.push_back(before / std::sqrt(ratio));
    diagonal.push_back(1.0 / step + before);
    residual -= step * product;
    image = applied(cycle, residual, scratch);
    const double next = residual.dot(image);
    ratio = next / norm;
    norm = next;
    search = image + ratio * search;
  }
  if (diagonal.empty()) return 0.0;  // something is not a number
  SquareMatrix lanczos(static_cast<int>(diagonal.size()));
  for (int i = 0; i < lanczos.size; ++i) {
    lanczos(i, i) = diagonal[i];
    if (i > 0) lanczos(i, i - 1) = off_diagonal[i - 1];
  }
  return symmetric_eigen(std::move(lanczos)).values.front();
}

}  // namespace snapspace
