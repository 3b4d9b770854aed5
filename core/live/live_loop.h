#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "material/tet_material.h"
#include "online/minimizer.h"
#include "online/row_clusters.h"

/// The reduced energies and live loops of core/online. Their layouts depend on the width of packs;
/// these interfaces do not, so code that uses them need not be compiled for every level.
namespace snapspace::live {

/// A function of d reduced coordinates q.
class ReducedFunction {
 public:
  virtual ~ReducedFunction() = default;
  [[nodiscard]] virtual int dimension() const = 0;
  /// Value at q (d); `gradient` (d) is overwritten.
  virtual double value_and_gradient(const double* q, double* gradient) = 0;
  /// Also writes the lower triangle of the Hessian (d x d).
  virtual double derivatives(const double* q, double* gradient, double* hessian) = 0;
};

/// A weighted sum over few tets.
class TetFunction : public ReducedFunction {
 public:
  [[nodiscard]] virtual int tets() const = 0;
  /// Hessians of the tets' energies at q (d) with respect to their displacement gradients, tets x 9
  /// x 9.
  virtual void curvatures(const double* q, float* hessians) = 0;
  /// Stresses of the tets at q (d), tets x 9.
  virtual void stresses(const double* q, float* stresses) = 0;
};

/// A live solver.
class LiveSolver : public ReducedFunction {
 public:
  /// False if the Hessian at rest is not positive definite, or the Hessian at the mean shape is far
  /// from it: a solve then has no matrix to start from.
  [[nodiscard]] virtual bool valid() const = 0;
  [[nodiscard]] virtual int capacity() const = 0;
  /// Restricts the problem to the first coordinates, 1 <= dimension <= capacity.
  virtual void set_dimension(int dimension) = 0;
  /// Solves from q, in place.
  virtual online::Report solve(double* q, online::Method method,
                               const online::Termination& stop) = 0;
  /// Steps in time from q, in place, with inertia of this weight about the target (d). The first
  /// call allocates memory.
  virtual online::StepReport step(double* q, double weight, const double* target,
                                  online::Method method, const online::Termination& stop) = 0;
  /// The smallest curvature at q = 0, for handles at rest or equal weights.
  virtual double softest() = 0;
  /// How many inputs a frame sets: offsets (12 numbers each) of handles, or weights of poses.
  [[nodiscard]] virtual int inputs() const = 0;
  virtual void set_inputs(const double* inputs) = 0;
};

/// Displacement gradients of tets; see online::TetRows.
struct RowArrays {
  int dimension, tets;
  const float* rows;
  online::RowClusters clusters;
};

/// The arrays of a cubature; see online::Cubature.
struct CubatureArrays {
  RowArrays rows;
  const double* weights;
  TetMaterial material;
};

/// Some tets of a body in several poses; see online::PoseTets.
struct PoseArrays {
  int poses;
  const double *corners, *tau;
};

/// Some stars of a surface in several poses; see online::PoseStars.
struct StarArrays {
  int dimension, poses, stars;
  const float* rows;
  const double* weights;
  TetMaterial material;
  const double *origins, *forms;
};

/// A blended energy, whose weights can be set.
class BlendedFunction : public TetFunction {
 public:
  [[nodiscard]] virtual int poses() const = 0;
  virtual void set_weights(const double* weights) = 0;
};

/// K, L and S of some handles; see online::HandleQuadric.
struct HandleArrays {
  int handles;
  const double *K, *L, *S;
};

using FunctionPointer = std::unique_ptr<ReducedFunction>;
using TetPointer = std::unique_ptr<TetFunction>;
using BlendedPointer = std::unique_ptr<BlendedFunction>;
using SolverPointer = std::unique_ptr<LiveSolver>;

/// Coefficients of a quartic in d variables.
[[nodiscard]] std::size_t coefficient_count(int dimension);

/// @param single  whether coefficients are stored in single precision
[[nodiscard]] FunctionPointer quartic(int dimension, const double* coefficients, bool single);
[[nodiscard]] TetPointer cubature(const CubatureArrays& arrays);
[[nodiscard]] BlendedPointer blended_cubature(const CubatureArrays& arrays,
                                              const PoseArrays& poses);
[[nodiscard]] BlendedPointer blended_stars(const StarArrays& arrays);
[[nodiscard]] SolverPointer posing_solver(int dimension, const double* coefficients, bool single,
                                          const HandleArrays& handles);
[[nodiscard]] SolverPointer posing_solver(const CubatureArrays& arrays,
                                          const HandleArrays& handles);
/// Refers to the coefficients, poses x coefficient_count(dimension).
[[nodiscard]] SolverPointer blending_solver(int dimension, int poses, const double* coefficients,
                                            bool single);
[[nodiscard]] SolverPointer blending_solver(const CubatureArrays& arrays, const PoseArrays& poses);
[[nodiscard]] SolverPointer blending_solver(const StarArrays& arrays);

}  // namespace snapspace::live
