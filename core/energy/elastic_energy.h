#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "element/tet.h"
#include "energy/material_field.h"
#include "energy/negligible_strain.h"
#include "energy/vertex_stars.h"
#include "mesh/rest_shape.h"
#include "mesh/sweep.h"
#include "simd/lanes.h"
#include "simd/packs.h"

namespace snapspace {

/// Elastic energy of a mesh: the sum over tets of volume * density, as a function of displacements
/// u (3n, x0 y0 z0 x1 ...) from the rest shape. For a shell, the tets are triangles and hinges.
/// Real is double, or a pack with one sample per lane. Templates over densities end at this class:
/// its sums are compiled for every density and pack, and one is chosen for every few dozen tets.
/// Solvers and other callers do not depend on the density.
class ElasticEnergy {
 public:
  /// @throws std::invalid_argument  if the material has moduli for a different number of tets
  ElasticEnergy(RestShape shape, MaterialField field);

  RestShape rest;
  MaterialField material;
  /// The elements of an as-rigid-as-possible surface, instead of the triangles.
  std::optional<VertexStars> stars;

  [[nodiscard]] int elements() const { return stars ? stars->count() : tets(); }
  [[nodiscard]] int tets() const { return static_cast<int>(rest.tets.size()); }

  /// Energy of the elements from `begin` to before `end` at u; adds its gradient to `gradient`
  /// (3n).
  template <class Real>
  [[nodiscard]] Sum<Real> add_value_and_gradient(int begin, int end, const Real* u,
                                                 Real* gradient) const;

  /// Energy at u; `gradient` (3n) is overwritten. The visitor's `before` is called for a vertex
  /// before u is read and the gradient is written there.
  template <class Real>
  Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) const {
    Sum<Real> energy(0.0);
    SweepStop last{0, 0, 0};
    for (const SweepStop& stop : stars ? stars->stops : rest.stops) {
      visitor.before(last.reached, stop.reached);
      std::fill(gradient + 3 * last.reached, gradient + 3 * stop.reached, Real(0.0));
      energy += add_value_and_gradient(last.tets, stop.tets, u, gradient);
      visitor.after(last.complete, stop.complete);
      last = stop;
    }
    return energy;
  }
  template <class Real>
  Sum<Real> value_and_gradient(const Real* u, Real* gradient) const {
    SweepVisitor idle;
    return value_and_gradient(u, gradient, idle);
  }
  /// The same for a single sample, in a lane of a narrow pack, so that the result is bitwise the
  /// same alone and beside other samples.
  double value_and_gradient(const double* u, double* gradient, SweepVisitor& visitor) const;

  /// Hessian at rest times v, which is linear elasticity; `product` (3n) is overwritten.
  template <class Real>
  void rest_hessian_product(const Real* v, Real* product) const;

  /// Hessian at u times v; `product` (3n) is overwritten.
  void hessian_product(const double* u, const double* v, double* product) const;

  /// Volume times first Piola-Kirchhoff stress (elements x 9, row by row) and energies (elements)
  /// at u. For stars, they are those of the density ShellArap.
  void tet_stresses(const double* u, double* stresses, double* energies) const;
  /// The same for some elements, in their order.
  void tet_stresses(const std::vector<std::int32_t>& which, const double* u, double* stresses,
                    double* energies) const;

  /// 2 mu + lam of each tet: the largest stiffness of its small strains.
  [[nodiscard]] std::vector<double> stiffnesses() const;

  /// What a tet contributes to the scalar matrix: the gradients of its hat functions, one per row.
  /// For a hinge, the first column has the derivatives of the flat hinge's angle with respect to
  /// the heights of its corners.
  [[nodiscard]] Eigen::Matrix<double, 4, 3> scalar_gradients(int tet) const;

  /// The numbers of an element's rest shape, see ShellDensity; for shells only.
  [[nodiscard]] const double* rest_numbers(int element) const {
    return material.view().of(element) + scaled_moduli(material.view().kind);
  }

  /// The n x n matrix that stands for the Hessian in each of x, y and z: the sum over tets of
  /// stiffness * volume * the products of scalar gradients. For a solid, it is the Laplacian (the
  /// cotangent Laplacian of tets); for a shell, the Laplacian of its triangles plus the isometric
  /// bending of its hinges [Bergou, Wardetzky, Harmon, Zorin, Grinspun 2006]. Positive
  /// semi-definite.
  [[nodiscard]] Eigen::SparseMatrix<double> scalar_matrix() const;

  /// Energy of a strain of kNegligibleStrain everywhere. Smaller decreases count as zero: where the
  /// minimum of an objective is zero, a tolerance relative to it can never be met.
  [[nodiscard]] double negligible() const { return negligible_; }

  /// A power of two near the largest force of an element at a strain of one. In single precision,
  /// forces are computed in this unit: if the unit of length is far from the body's size, volume
  /// times modulus leaves the range of floats where forces do not. A power of two changes no
  /// digits.
  [[nodiscard]] double force_unit() const { return force_unit_; }

  /// Number of elements with det F <= 0; none in a shell, which has no inside.
  [[nodiscard]] int inverted_tets(const double* u) const;

 private:
  /// @param which  count elements; null: the first ones
  void stresses_at(int count, const std::int32_t* which, const double* u, double* stresses,
                   double* energies) const;

  template <class T>
  [[nodiscard]] const StreamedVector<T>& weighted_moduli() const;
  template <class Real>
  void add_shell_rest_product(const Real* v, Real* product) const;

  StreamedVector<double> moduli_;        // moduli of each tet times its volume
  StreamedVector<float> single_moduli_;  // the same in single precision
  double force_unit_;
  StreamedVector<double> lame_;  // lam and mu of small strains, times volume, by the force unit
  double negligible_;
};

#define SNAPSPACE_DECLARED(Real)                                                                \
  extern template Sum<Real> ElasticEnergy::add_value_and_gradient(int, int, const Real*, Real*) \
      const;                                                                                    \
  extern template void ElasticEnergy::rest_hessian_product(const Real*, Real*) const;
SNAPSPACE_LANE_PACKS(SNAPSPACE_DECLARED)
#undef SNAPSPACE_DECLARED

}  // namespace snapspace
