#pragma once
#include <cstddef>
#include <vector>

#include "material/tet_material.h"
#include "simd/lanes.h"

namespace snapspace::online {

/// An elastic energy as a weighted sum over few tets: E(q) = sum_e w_e psi_e(G_e q), where G_e (9 x
/// d) makes the displacement gradient of tet e from the reduced coordinates, for any density.
///
/// With positive weights (cubature [An, Kim & James 2008]) it is as bounded below as the material.
/// An evaluation costs 18 r d multiply-adds for r tets and reads each G_e once from memory, which
/// is what takes the time. Its entries are rounded to 2^-21, two in a word (simd/number_pairs.h):
/// a tiny change of the modes. All arithmetic is in double, so that value and gradient belong
/// together to full precision; in single precision line searches get stuck in the noise. One tet
/// per SIMD lane. Takes no memory after construction.
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

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int capacity() const { return capacity_; }

  /// Restricts the energy to the first coordinates, 1 <= dimension <= capacity.
  void set_dimension(int dimension);

  /// Value at q (d); `gradient` (d) is overwritten.
  double value_and_gradient(const double* q, double* gradient);

  /// Also the lower triangle of the Hessian (d x d), which is overwritten; 9/2 r d^2 multiply-adds
  /// more.
  double derivatives(const double* q, double* gradient, double* hessian);

 private:
  static constexpr int kWidth = kWideLanes;
  using Tets = Lanes<kWidth>;

  void set_coordinates(const double* q);
  [[nodiscard]] const Tets* block(std::size_t index) const {
    return words_.data() + index * 9 * ((capacity_ + 1) / 2);
  }
  /// Displacement gradients of a block's tets.
  void gradients(const Tets* words, Tets G[3][3]) const;
  /// One mode's displacement gradients.
  [[nodiscard]] static Tets entry(const Tets* words, int mode, int e);
  [[nodiscard]] int blocks() const { return (tets_ + kWidth - 1) / kWidth; }
  template <class Density>
  double add_values_and_stresses();
  void curvatures(int block, const Tets G[3][3], Tets hessian[9][9]) const;

  int capacity_, dimension_;
  int pairs_;  // of modes, those of the dimension
  int kind_, tets_, moduli_count_;
  std::vector<Tets> words_;   // block of kWidth tets, pair of modes, entry of G; an odd last
                              // mode is joined by zeros
  std::vector<Tets> moduli_;  // block, modulus: times the weight; zero for lanes without a tet
  std::vector<double> coordinates_;  // q, and a zero if d is odd
  std::vector<Tets> sums_;           // gradient, lane by lane
};

}  // namespace snapspace::online
