#pragma once
#include <vector>

#include "material/tet_material.h"
#include "online/half_runner.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// An elastic energy as a weighted sum over few tets, for any density: E(q) = sum_e w_e psi_e(G_e
/// q), where G_e (9 x d) maps the reduced coordinates to the displacement gradient of tet e.
/// With positive weights (cubature [An, Kim & James 2008]) it is bounded below if the density is.
/// An evaluation costs 18 r d multiply-adds for r tets, see TetRows. Allocates no memory after
/// construction.
class Cubature final : public TetEnergies {
 public:
  /// Whether a Hessian costs much more than a gradient.
  static constexpr bool kHessianIsExpensive = true;

  /// Copies its arrays.
  /// @param rows  tets x 9 x dimension; entry 3 a + b of the second index is d u_a / d x_b
  /// @param weights  tets, the volume that each represents
  /// @param material  of these tets
  /// @param clusters  if given, rows are those of local coordinates, see TetRows
  Cubature(int dimension, int tets, const float* rows, const double* weights,
           const TetMaterial& material, const RowClusters& clusters = {});

  [[nodiscard]] int dimension() const { return rows_.dimension(); }
  [[nodiscard]] int capacity() const { return rows_.capacity(); }

  /// Restricts the energy to the first coordinates, 1 <= dimension <= capacity.
  void set_dimension(int dimension) { rows_.set_dimension(dimension); }

  /// Sets the runner of large evaluations; null for this thread alone. Results are the same.
  void set_half_runner(HalfRunner* runner) { half_runner_ = runner; }
  [[nodiscard]] HalfRunner* half_runner() const { return half_runner_; }

  /// Value at q (d); `gradient` (d) is overwritten.
  double value_and_gradient(const double* q, double* gradient);

  /// Also overwrites the lower triangle of the Hessian (d x d); takes 9/2 r d^2 more multiply-adds.
  double derivatives(const double* q, double* gradient, double* hessian);

  [[nodiscard]] int tets() const { return rows_.tets(); }
  /// Weighted Hessians of the tets' energies at q (d) with respect to their displacement gradients,
  /// tets x 9 x 9.
  void curvatures(const double* q, float* hessians);
  /// Weighted stresses of the tets at q (d), tets x 9.
  void stresses(const double* q, float* stresses);

  /// See TetEnergies.
  Tets block_energy(int block, const Tets G[3][3], Tets P[3][3]) const override;
  void block_curvatures(int block, const Tets G[3][3], Tets hessian[9][9]) const override;

 private:
  TetRows rows_;
  HalfRunner* half_runner_ = nullptr;
  std::vector<double> second_half_;  // Hessian of the second half of the blocks
  int kind_, moduli_count_;
  std::vector<Tets> moduli_;  // block, modulus: times weight; zero for lanes without a tet
};

}  // namespace snapspace::online
