#pragma once
#include <vector>

#include "material/tet_material.h"
#include "online/half_runner.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// Some stars of an as-rigid-as-possible surface in several poses. Every pose has its own
/// stars at the same vertices, so all arrays begin with a pose.
struct PoseStars {
  int poses, stars;
  const float* rows;      ///< poses x stars x 9 x dimension, the nine numbers of the modes
  const double* weights;  ///< stars, the area in pose 0 that each represents
  TetMaterial material;   ///< of poses x stars rows
  const double* origins;  ///< poses x stars x 9: the nine numbers at zero reduced coordinates
  const double* forms;    ///< poses x (d + 1) x (d + 1), what the stars leave of each energy: a
                          ///< symmetric matrix M for the value (q, 1)^T M (q, 1)
};

/// The blended energy sum_k w_k E_k of an as-rigid-as-possible surface: a weighted sum over few
/// stars, the same for all poses, and an exact quadratic form for the rest; see VertexStars. The
/// rotations of a star differ from pose to pose, so an evaluation costs 18 r d multiply-adds for
/// each pose whose weight is not zero. Allocates no memory after construction.
class BlendedStars final : public TetEnergies {
 public:
  static constexpr bool kHessianIsExpensive = true;

  /// Copies its arrays. The weights of the poses are initially zero.
  BlendedStars(int dimension, const PoseStars& stars);

  [[nodiscard]] int poses() const { return static_cast<int>(weights_.size()); }
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

  /// Stars times poses.
  [[nodiscard]] int tets() const { return rows_.tets(); }
  /// Weighted Hessians of the stars' energies at q (d) with respect to their nine numbers, pose by
  /// pose: poses x stars x 9 x 9. The quadratic form is not part of them.
  void curvatures(const double* q, float* hessians);
  /// Weighted derivatives of the stars' energies with respect to these numbers, poses x stars x 9.
  void stresses(const double* q, float* stresses);

  /// See TetEnergies; `modes` are their nine numbers.
  Tets block_energy(int block, const Tets modes[3][3], Tets P[3][3]) const override;
  void block_curvatures(int block, const Tets modes[3][3], Tets hessian[9][9]) const override;

 private:
  void add_origins(int block, const Tets modes[3][3], Tets G[3][3]) const;
  double add_form(const double* q, double* gradient) const;

  TetRows rows_;
  HalfRunner* half_runner_ = nullptr;
  std::vector<double> second_half_;  // Hessian of the second half of the blocks
  int kind_, moduli_count_;
  std::vector<double> weights_;  // of the poses
  std::vector<double> forms_;    // of the poses
  std::vector<double> form_;     // their weighted sum
  std::vector<double> areas_;    // pose, star: modulus times the area
  std::vector<Tets> origins_;    // block, entry
  std::vector<Tets> moduli_;     // block, modulus: times area and the pose's weight
};

}  // namespace snapspace::online
