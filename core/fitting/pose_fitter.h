#pragma once
#include <vector>

#include "cholesky/scalar_factor.h"
#include "cholesky/supernodes.h"
#include "fitting/fit_energy.h"
#include "fitting/fitting_system.h"
#include "snapshots/conjugate_gradients.h"
#include "snapshots/solve_report.h"

namespace snapspace {

enum class FitStatus : int {
  converged = 0,
  max_iterations = 1,
  stiffness_limit = 2,  ///< the target is not reached even with the stiffest surface
  line_search_failed = 3,
  cancelled = 4,
};

struct FitOptions {
  double deviation = 0.0;        ///< goal: root mean square distance of surface and target
  double first_stiffness = 0.0;  ///< stiffness of the surface at first; see PoseFitter
  double stretch = 0.0;          ///< bound for every tet; see BoundedStretch
  int max_iterations = 300;      ///< maximum of Newton steps in all stages
};

struct FitReport {
  FitStatus status = FitStatus::cancelled;
  int stages = 0;
  int iterations = 0;
  int evaluations = 0;
  int linear_iterations = 0;
  double stiffness = 0.0;  ///< stiffness in the last stage
  double deviation = 0.0;  ///< at the returned shape
  double seconds = 0.0;
};

/// Displacements of a tet mesh that bring its surface to a target, without inverted tets.
/// Minimises F(u) = symmetric Dirichlet energy, bounded in stretch, + springs whose stiffness is
/// raised in stages until the surface is near enough. The first stage must be so soft that the
/// shape bends towards its pose instead of stretching: limbs that are pulled hard through the body
/// get caught in folds that no later stage undoes.
/// Each stage is solved by Newton's method on the projected Hessian. The linear systems are solved
/// by conjugate gradients, preconditioned by a scalar matrix: the mean of the diagonal of each 3 x
/// 3 block. It follows the compressed tets, whose stiffness varies by orders of magnitude, so 5 to
/// 20 iterations suffice; L-BFGS on the Laplacian of the rest shape fails on such tets.
class PoseFitter {
 public:
  PoseFitter(const FittingSystem& system, const FitOptions& options);

  /// @param targets  displacements of the surface points, 3 per point
  /// @param shape    displacements of the vertices in the internal numbering, with finite energy
  FitReport fit(const double* targets, const std::vector<double>& shape,
                const SolveControl& control);

  /// Displacements in the internal numbering.
  [[nodiscard]] const std::vector<double>& shape() const { return u_; }

 private:
  void start(const std::vector<double>& shape);
  void take_step(const SolveControl& control);
  double value_and_gradient(const std::vector<double>& u, std::vector<double>& gradient);
  double find_direction(const SolveControl& control);
  bool line_search(double slope);
  void set_limits();
  [[nodiscard]] bool raise_stiffness();
  [[nodiscard]] Eigen::SparseMatrix<double> scalar_matrix() const;

  const FittingSystem& system_;
  FitOptions options_;
  FitEnergy energy_;
  BlockHessian hessian_;
  ConjugateGradients conjugate_gradients_;
  const double* targets_ = nullptr;
  FitReport report_;
  Supernodes supernodes_;  // for the scalar matrix, the same in every step
  double value_ = 0.0;
  double decrement_ = 0.0;  // -g.d of the last direction d
  bool done_ = false;
  // Per tet: the largest energy allowed, the energy at the last trial, and the stress there.
  std::vector<double> limits_, energies_, stresses_;
  std::vector<double> u_, gradient_, direction_, trial_, trial_gradient_;
};

}  // namespace snapspace
