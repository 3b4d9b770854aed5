#pragma once
#include <vector>

#include "material/tet_material.h"
#include "online/half_runner.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// Some tets of a body in several poses, or some elements of a shell.
struct PoseTets {
  int poses;
  const double* corners;  ///< poses x tets x 4 x 3: the tets in each pose, none without volume
  const double* tau;      ///< tets x 4 x 3: the tets at zero reduced coordinates
};

/// The blended energy sum_k w_k E_k of several poses as a weighted sum over few tets, the same for
/// all poses, and for any density. See PoseBlend for the energy of a tet.
/// A density that collapses is evaluated once per tet, for any number of poses; the others once per
/// tet and pose. Allocates no memory after construction.
class BlendedCubature final : public TetEnergies {
 public:
  static constexpr bool kHessianIsExpensive = true;

  /// Copies its arrays. The weights of the poses are initially zero.
  /// @param rows  tets x 9 x dimension, displacement gradients of the modes relative to pose 0
  /// @param weights  tets, the volume in pose 0 that each represents
  /// @param material  of these tets; for a shell, that of pose 0, see shell_pose_materials
  /// @param clusters  if given, rows are those of local coordinates, see TetRows
  BlendedCubature(int dimension, int tets, const float* rows, const double* weights,
                  const TetMaterial& material, const PoseTets& poses,
                  const RowClusters& clusters = {});

  [[nodiscard]] int poses() const { return poses_; }
  [[nodiscard]] int dimension() const { return rows_.dimension(); }
  [[nodiscard]] int capacity() const { return rows_.capacity(); }

  /// Restricts the energy to the first coordinates, 1 <= dimension <= capacity.
  void set_dimension(int dimension) { rows_.set_dimension(dimension); }

  /// Sets the weights of the poses.
  void set_weights(const double* weights);

  /// Sets the runner of large evaluations; null for this thread alone. Results are the same.
  void set_half_runner(HalfRunner* runner) { half_runner_ = runner; }
  [[nodiscard]] HalfRunner* half_runner() const { return half_runner_; }

  /// Value at q (d); `gradient` (d) is overwritten.
  double value_and_gradient(const double* q, double* gradient);

  /// Also the lower triangle of the Hessian (d x d), which is overwritten.
  double derivatives(const double* q, double* gradient, double* hessian);

  [[nodiscard]] int tets() const { return rows_.tets(); }
  /// Weighted Hessians of the tets' energies at q (d) with respect to their displacement gradients,
  /// tets x 9 x 9.
  void curvatures(const double* q, float* hessians);
  /// Weighted stresses of the tets at q (d), tets x 9.
  void stresses(const double* q, float* stresses);

  /// See TetEnergies; `modes` are the displacement gradients of the modes.
  Tets block_energy(int block, const Tets modes[3][3], Tets P[3][3]) const override;
  void block_curvatures(int block, const Tets modes[3][3], Tets hessian[9][9]) const override;

 private:
  void set_tet(int tet, double weight, const double* moduli, const PoseTets& poses);
  void add_offsets(int block, const Tets modes[3][3], Tets G[3][3]) const;
  void add_curvature(int tet, int pose, const double G[3][3], double hessian[9][9]) const;
  void shell_curvature(int block, int lane, const double G[3][3], double hessian[9][9]) const;

  TetRows rows_;
  HalfRunner* half_runner_ = nullptr;
  std::vector<double> second_half_;  // Hessian of the second half of the blocks
  int kind_, poses_;
  bool collapses_;
  int numbers_count_, moduli_count_;   // per tet and pose
  int sums_count_;                     // the numbers that are summed over the poses
  std::vector<double> weights_;        // weights of the poses
  std::vector<Tets> offsets_;          // block, entry: displacement gradients of tau
  std::vector<double> maps_, moduli_;  // tet, pose: A - I, and the moduli times volume
  std::vector<Tets> numbers_;          // block, pose: see PoseBlend
  std::vector<Tets> blend_;            // block: numbers summed over the poses, or the weights
};

}  // namespace snapspace::online
