#pragma once
#include "material/stvk.h"
#include "mesh/rest_shape.h"

/// St.Venant-Kirchhoff element kernels: energy = volume * psi. Real is double, or Lanes for one
/// sample per lane.
namespace snapspace {

/// Displacements of vertices 1, 2, 3 of a tet against vertex 0, as columns. Differences of nodal
/// values come first: sums over all four vertices would lose digits on slivers.
template <class Real, class T>
inline void edge_displacements(const RestTetOf<T>& tet, const Real* u, Real D[3][3]) {
  const Real* u0 = u + 3 * tet.vertices[0];
  for (int j = 0; j < 3; ++j) {
    const Real* uj = u + 3 * tet.vertices[j + 1];
    for (int r = 0; r < 3; ++r) D[r][j] = uj[r] - u0[r];
  }
}

/// G = D * inverse_edges.
template <class Real, class T>
inline void gradient_of_edges(const RestTetOf<T>& tet, const Real D[3][3], Real G[3][3]) {
  const T(*B)[3] = tet.inverse_edges;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) G[r][c] = D[r][0] * B[0][c] + D[r][1] * B[1][c] + D[r][2] * B[2][c];
}

/// Displacement gradient G = sum_j (u_j - u_0) (x) (row j of inverse_edges), constant in the tet.
template <class Real, class T>
inline void displacement_gradient(const RestTetOf<T>& tet, const Real* u, Real G[3][3]) {
  Real D[3][3];
  edge_displacements(tet, u, D);
  gradient_of_edges(tet, D, G);
}

/// P * inverse_edges^T, whose columns belong to vertices 1, 2, 3: P : grad(phi_j). With the first
/// Piola-Kirchhoff stress times volume that is the energy's gradient, with its differential a
/// Hessian-vector product.
template <class Real, class T>
inline void vertex_forces(const RestTetOf<T>& tet, const Real P[3][3], Real forces[3][3]) {
  const T(*B)[3] = tet.inverse_edges;
  for (int r = 0; r < 3; ++r)
    for (int j = 0; j < 3; ++j)
      forces[r][j] = P[r][0] * B[j][0] + P[r][1] * B[j][1] + P[r][2] * B[j][2];
}

/// Adds the forces of a tet's vertices 1, 2, 3, and their negative sum at vertex 0, to a gradient.
template <class Real, class T>
inline void scatter_forces(const RestTetOf<T>& tet, const Real forces[3][3], Real* gradient) {
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

/// The same for a first stress that is times volume already.
template <class Real, class T>
inline void scatter_stress(const RestTetOf<T>& tet, const Real P[3][3], Real* gradient) {
  Real forces[3][3];
  vertex_forces(tet, P, forces);
  scatter_forces(tet, forces, gradient);
}

/// Energy of one element at displacements u; adds its gradient to `gradient`. Compilers find it too
/// long to be part of loops over elements, and a call costs a tenth.
template <class Real, class T>
#if defined(__GNUC__)
[[gnu::always_inline]]
#endif
inline Real stvk_energy_and_gradient(const StVK& material, const RestTetOf<T>& tet, const Real* u,
                                     Real* gradient) {
  Real G[3][3], S[3][3], P[3][3];
  displacement_gradient(tet, u, G);
  const Real energy = volume_stress(Real(static_cast<T>(material.lam) * tet.volume),
                                    Real(static_cast<T>(material.mu) * tet.volume), G, S);
  first_stress(G, S, P);
  scatter_stress(tet, P, gradient);
  return energy;
}

/// Adds H v of one element at displacements u to `product`.
template <class Real, class T>
inline void stvk_hessian_product(const StVK& material, const RestTetOf<T>& tet, const Real* u,
                                 const Real* v, Real* product) {
  Real G[3][3], S[3][3], dF[3][3], dP[3][3];
  displacement_gradient(tet, u, G);
  displacement_gradient(tet, v, dF);
  stress(material, G, S);
  stress_differential(material, G, S, dF, dP);
  for (auto& row : dP)
    for (Real& entry : row) entry *= Real(tet.volume);
  scatter_stress(tet, dP, product);
}

/// Adds H v of one element at rest to `product`.
template <class Real, class T>
inline void stvk_rest_hessian_product(const StVK& material, const RestTetOf<T>& tet, const Real* v,
                                      Real* product) {
  Real G[3][3], P[3][3];
  displacement_gradient(tet, v, G);
  const Real mu(static_cast<T>(material.mu) * tet.volume);
  const Real pressure =
      Real(static_cast<T>(material.lam) * tet.volume) * (G[0][0] + G[1][1] + G[2][2]);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) P[r][c] = mu * (G[r][c] + G[c][r]);
    P[r][r] += pressure;
  }
  scatter_stress(tet, P, product);
}

}  // namespace snapspace
