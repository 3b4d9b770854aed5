#pragma once
#include <vector>

#include "material/tet_material.h"
#include "online/halves.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// An elastic energy as a weighted sum over few tets: E(q) = sum_e w_e psi_e(G_e q), where G_e
/// (9 x d) makes the displacement gradient of tet e from the reduced coordinates, for any density.
///
/// With positive weights (cubature [An, Kim & James 2008]) it is as bounded below as the material.
/// An evaluation costs 18 r d multiply-adds for r tets, see TetRows. Takes no memory after
/// construction.
class Cubature {
 public:
  /// Whether a Hessian costs much more than a gradient.
  static constexpr bool kHessianIsDear = true;

  /// Copies its arrays.
  /// @param rows  tets x 9 x dimension; entry 3 a + b of the second is d u_a / d x_b
  /// @param weights  tets, the volume that each stands for
  /// @param material  of these tets
  Cubature(int dimension, int tets, const float* rows, const double* weights,
           const TetMaterial& material);

  [[nodiscard]] int dimension() const { return rows_.dimension(); }
  [[nodiscard]] int capacity() const { return rows_.capacity(); }

  /// Restricts the energy to the first coordinates, 1 <= dimension <= capacity.
  void set_dimension(int dimension) { rows_.set_dimension(dimension); }

  /// Who runs large evaluations from now on; null for this thread alone. The result is the same.
  void set_halves(Halves* halves) { halves_ = halves; }

  /// Value at q (d); `gradient` (d) is overwritten.
  double value_and_gradient(const double* q, double* gradient);

  /// Also the lower triangle of the Hessian (d x d), which is overwritten; 9/2 r d^2 multiply-adds
  /// more.
  double derivatives(const double* q, double* gradient, double* hessian);

  [[nodiscard]] int tets() const { return rows_.tets(); }
  /// Hessians of the tets at q (d) by their displacement gradients, tets x 9 x 9, with weights.
  void curvatures(const double* q, float* hessians);

 private:
  using Tets = TetRows::Tets;

  void block_curvatures(int block, Tets hessian[9][9]) const;

  TetRows rows_;
  Halves* halves_ = nullptr;
  int kind_, moduli_count_;
  std::vector<Tets> moduli_;  // block, modulus: times the weight; zero for lanes without a tet
};

}  // namespace snapspace::online
