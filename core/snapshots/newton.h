#pragma once
#include <vector>

#include "energy/block_hessian.h"
#include "snapshots/conjugate_gradients.h"
#include "snapshots/sample_queue.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// The paper's snapshot solver (sec. 4.2): Newton's method with the Hessian assembled from elements
/// at their clamped signed SVD, and a line search. The linear systems are solved by conjugate
/// gradients on the objective's preconditioner.
///
/// @tparam Objective  of one lane; has what LaneLbfgs needs, hessian_pattern() and
///                    assemble(u, clamp, hessian)
template <class Objective>
class Newton {
 public:
  /// @param clamp  singular values are raised to at least this; the paper uses 0.5 to 0.8
  Newton(Objective objective, const SolveOptions& options, double clamp);

  /// Solves one sample; its shape is left in shape().
  SolveReport solve(const Sample& sample, const SolveControl& control);

  [[nodiscard]] const std::vector<double>& shape() const { return u_; }
  [[nodiscard]] long linear_iterations() const { return linear_iterations_; }

 private:
  double find_direction(double relative_residual, const SolveControl& control);
  bool line_search(SolveReport& report, double slope);

  Objective objective_;
  SolveOptions options_;
  double clamp_;
  BlockHessian hessian_;
  ConjugateGradients conjugate_gradients_;
  long linear_iterations_ = 0;
  std::vector<double> u_, gradient_, direction_, trial_, trial_gradient_;
};

}  // namespace snapspace
