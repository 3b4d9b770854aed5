#pragma once
#include <Eigen/Core>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "material/tet_material.h"
#include "memory/streamed_vector.h"
#include "mesh/incidence.h"
#include "mesh/rest_shape.h"
#include "mesh/star_hats.h"
#include "simd/lanes.h"

namespace snapspace {

/// The as-rigid-as-possible (ARAP) energy of a surface, spokes and rims [Sorkine, Alexa 2007;
/// Chao, Pinkall, Sanan, Schroeder 2010]:
///   E = sum over stars i, sum over triangles t of i, of weight_it |F_t - R_i T_t|^2,
/// with the deformation gradient F_t (3 x 2) in the tangent frame T_t. The weight is a third of the
/// triangle's area times its modulus times the sum of the star's hats at its corners, and R_i is
/// the rotation nearest to the sum of weight_it F_t T_t^T. Hats sum to one at every vertex. If the
/// stars are the one-rings of all vertices, this is the usual energy of edges with cotangent
/// weights. Larger stars are like the rotation clusters of Jacobson, Baran, Kavan, Popovic, Sorkine
/// 2012, but overlap.
///
/// With M_i = L_i L_i^T the mean of T_t T_t^T, the rotation depends only on the nine numbers H_i =
/// mean of (F_t - T_t) T_t^T, times L_i^-T. E is a quadratic form of the displacements, which
/// measures how much the triangles of each star differ from its best affine map, plus the sum over
/// all stars of their weight times the density ShellArap at H_i. Neither part is negative.
class VertexStars {
 public:
  /// @param material  of the triangles: rows of ShellArap
  VertexStars(const RestShape& rest, const TetMaterial& material, const StarHats& hats);

  [[nodiscard]] int count() const { return static_cast<int>(weights.size()); }

  std::vector<SweepStop> stops;  ///< stops of a pass over the stars; `tets` are stars

  /// Corners of star i, first its center: first_corner[i] to before first_corner[i + 1]. H_i is the
  /// sum of u_j (x) gradient_j. Centers ascend.
  std::vector<std::int32_t> first_corner, corners;
  std::vector<double> gradients;  ///< three per corner
  std::vector<double> frames;     ///< L, row by row, nine per star
  std::vector<double> weights;    ///< sums of the triangles' weights
  std::vector<double> areas;      ///< the same with areas instead of areas times moduli
  /// Neighbours of vertex i: first_neighbour[i] to before first_neighbour[i + 1]. The Dirichlet
  /// energy, the sum of weight_it |F_t - T_t|^2 over all stars and their triangles, is the sum over
  /// all pairs of u_i . (u_j - u_i) times the coupling.
  std::vector<std::int32_t> first_neighbour, neighbours;
  std::vector<double> couplings;

  /// Row of ShellArap of a star of modulus one.
  void write_numbers(int star, double* numbers) const;

  /// Triangles of star i, ascending: first_triangle[i] to before first_triangle[i + 1]. Their
  /// weights in the star are these shares of a third of area times modulus: the sums of the star's
  /// hats at their corners.
  std::vector<std::int32_t> first_triangle, triangles;
  std::vector<double> shares;

  [[nodiscard]] std::int32_t center(int star) const { return corners[first_corner[star]]; }

  /// Energy of the stars from `begin` to before `end` at u; adds its gradient to `gradient` (3n).
  template <class Real>
  [[nodiscard]] Sum<Real> add_value_and_gradient(int begin, int end, const Real* u,
                                                 Real* gradient) const;

  /// Adds the Hessian at rest times v to `product` (3n).
  template <class Real>
  void add_rest_product(const Real* v, Real* product) const;

  /// Adds the Hessian at u times v to `product` (3n).
  void add_hessian_product(const double* u, const double* v, double* product) const;

  /// H of a star (3 x 3).
  template <class Real>
  void gradient_of(int star, const Real* u, Real H[3][3]) const;

 private:
  /// A triangle at rest: its hat functions' gradients in the tangent frame, whose first vector is
  /// along the first edge, and that frame.
  template <class T>
  struct Triangle {
    T first[2], second;  ///< of the second corner, and of the third, along the second vector
    T frame[3][2];
    T weight;
    std::int32_t vertices[3];
  };
  /// What hot loops read, in the precision of T.
  template <class T>
  struct Numbers {
    StreamedVector<Triangle<T>> triangles;
    StreamedVector<T> gradients, frames, shares;
  };

  void find_triangles(const Incidence& incidence, int vertex_count, const StarHats& hats);
  void find_corners(const StarHats& hats);
  void find_couplings(const Incidence& incidence, int vertex_count);
  void make_star(int star);
  template <class T>
  [[nodiscard]] const Numbers<T>& numbers() const {
    if constexpr (std::is_same_v<T, float>)
      return single_;
    else
      return double_;
  }
  template <class Real, class Turn>
  Sum<Real> add_stars(int begin, int end, const Real* u, Real* gradient, const Turn& turn) const;

  Numbers<double> double_;
  Numbers<float> single_;
  // inverse of tr(M) I - M, nine per star: turns the torque of a small displacement into a rotation
  std::vector<double> inverse_inertias_;
};

}  // namespace snapspace
