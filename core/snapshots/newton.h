#pragma once
#include <memory>
#include <vector>

#include "snapshots/conjugate_gradients.h"
#include "snapshots/lane_objective.h"
#include "snapshots/sample_queue.h"
#include "snapshots/sample_system.h"
#include "snapshots/solve_report.h"

namespace snapspace {

/// Newton's method with projected Hessians and a line search; with Projection::stretches it is the
/// paper's snapshot solver (sec. 4.2). The linear systems are solved by conjugate gradients,
/// preconditioned by the system's inverse.
class Newton {
 public:
  Newton(const SampleSystem& system, const SolveOptions& options, const HessianOptions& hessian);

  /// Solves one sample; its shape is left in shape().
  SolveReport solve(const Sample& sample, const SolveControl& control);

  [[nodiscard]] const std::vector<double>& shape() const { return u_; }
  [[nodiscard]] long linear_iterations() const { return linear_iterations_; }

 private:
  double find_direction(double relative_residual, const SolveControl& control);
  bool line_search(SolveReport& report, double slope);

  double value_and_gradient(const std::vector<double>& u, std::vector<double>& gradient);

  const SampleSystem& system_;
  SolveOptions options_;
  HessianOptions hessian_options_;
  std::unique_ptr<LaneObjective<double>> objective_;
  BlockHessian hessian_;
  ConjugateGradients conjugate_gradients_;
  long linear_iterations_ = 0;
  std::vector<double> u_, gradient_, direction_, trial_, trial_gradient_;
};

}  // namespace snapspace
