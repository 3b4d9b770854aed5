#pragma once
#include "element/rest_tet.h"

/// Geometry of linear tets: displacement gradients from nodal displacements, and nodal forces from
/// stresses. Real is a number, or a pack with one sample per lane.
namespace snapspace {

/// Displacement gradient G = sum_j (u_j - u_0) (x) (row j of inverse_edges), constant in the tet.
/// Differences of nodal values are taken first: sums over all four vertices would lose digits on
/// slivers.
template <class Real, class T>
inline void displacement_gradient(const RestTetOf<T>& tet, const Real* u, Real G[3][3]) {
  Real D[3][3];
  const Real* u0 = u + 3 * tet.vertices[0];
  for (int j = 0; j < 3; ++j) {
    const Real* uj = u + 3 * tet.vertices[j + 1];
    for (int r = 0; r < 3; ++r) D[r][j] = uj[r] - u0[r];
  }
  const T(*B)[3] = tet.inverse_edges;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) G[r][c] = D[r][0] * B[0][c] + D[r][1] * B[1][c] + D[r][2] * B[2][c];
}

/// Adds the forces P * inverse_edges^T of vertices 1, 2, 3 of a tet, and their negative sum at
/// vertex 0, to `gradient`. With the first Piola-Kirchhoff stress times volume this is the energy's
/// gradient; with the stress's differential it is a Hessian-vector product.
template <class Real, class T>
inline void scatter_stress(const RestTetOf<T>& tet, const Real P[3][3], Real* gradient) {
  const T(*B)[3] = tet.inverse_edges;
  Real forces[3][3];
  for (int r = 0; r < 3; ++r)
    for (int j = 0; j < 3; ++j)
      forces[r][j] = P[r][0] * B[j][0] + P[r][1] * B[j][1] + P[r][2] * B[j][2];
  Real* g0 = gradient + 3 * tet.vertices[0];
  Real* g1 = gradient + 3 * tet.vertices[1];
  Real* g2 = gradient + 3 * tet.vertices[2];
  Real* g3 = gradient + 3 * tet.vertices[3];
  for (int r = 0; r < 3; ++r) {
    g0[r] -= forces[r][0] + forces[r][1] + forces[r][2];
    g1[r] += forces[r][0];
    g2[r] += forces[r][1];
    g3[r] += forces[r][2];
  }
}

}  // namespace snapspace
