#pragma once
#include "mesh/rest_shape.h"

/// St.Venant-Kirchhoff element kernels. Real is double, or Lanes for one sample per lane.
///
/// Strain E = (F^T F - I) / 2, density psi = mu |E|^2 + lam/2 tr(E)^2, energy = volume * psi
/// [Bonet & Wood 2007]. The kernels take displacements u, not positions: with the displacement
/// gradient G = F - I the strain is E = (G + G^T + G^T G) / 2, which keeps full precision for small
/// deformations and on slivers, where F^T F - I cancels. St.VK cannot tell an inverted element from
/// its mirror image: psi(F) = psi(-F).
namespace snapspace {

struct StVK {
  double lam;
  double mu;
};

/// Displacement gradient G = sum_j (u_j - u_0) (x) (row j of inverse_edges), constant in the tet.
template <class Real>
inline void displacement_gradient(const RestTet& tet, const Real* u, Real G[3][3]) {
  const Real* u0 = u + 3 * tet.vertices[0];
  const Real* u1 = u + 3 * tet.vertices[1];
  const Real* u2 = u + 3 * tet.vertices[2];
  const Real* u3 = u + 3 * tet.vertices[3];
  for (int r = 0; r < 3; ++r) {
    const Real d1 = u1[r] - u0[r];
    const Real d2 = u2[r] - u0[r];
    const Real d3 = u3[r] - u0[r];
    for (int c = 0; c < 3; ++c)
      G[r][c] = d1 * tet.inverse_edges[0][c] + d2 * tet.inverse_edges[1][c] +
                d3 * tet.inverse_edges[2][c];
  }
}

/// Second Piola-Kirchhoff stress S = 2 mu E + lam tr(E) I at G; returns the density psi.
template <class Real>
inline Real stress(const StVK& material, const Real G[3][3], Real S[3][3]) {
  Real E[3][3];
  for (int r = 0; r < 3; ++r)
    for (int c = r; c < 3; ++c) {
      const Real quadratic = G[0][r] * G[0][c] + G[1][r] * G[1][c] + G[2][r] * G[2][c];
      E[r][c] = (G[r][c] + G[c][r] + quadratic) * Real(0.5);
    }
  const Real trace = E[0][0] + E[1][1] + E[2][2];
  const Real pressure = trace * Real(material.lam);
  const Real two_mu(2.0 * material.mu);
  for (int r = 0; r < 3; ++r) {
    S[r][r] = E[r][r] * two_mu + pressure;
    for (int c = r + 1; c < 3; ++c) S[r][c] = S[c][r] = E[r][c] * two_mu;
  }
  const Real diagonal = E[0][0] * E[0][0] + E[1][1] * E[1][1] + E[2][2] * E[2][2];
  const Real off_diagonal = E[0][1] * E[0][1] + E[0][2] * E[0][2] + E[1][2] * E[1][2];
  return (diagonal + off_diagonal + off_diagonal) * Real(material.mu) +
         trace * pressure * Real(0.5);
}

/// Adds volume * P : grad(phi_j) to the entries of the element's vertices: the gradient of the
/// energy when P is the first Piola-Kirchhoff stress, a Hessian-vector product when P is its
/// differential.
template <class Real>
inline void scatter_stress(const RestTet& tet, const Real P[3][3], Real* gradient) {
  Real* g0 = gradient + 3 * tet.vertices[0];
  Real* g1 = gradient + 3 * tet.vertices[1];
  Real* g2 = gradient + 3 * tet.vertices[2];
  Real* g3 = gradient + 3 * tet.vertices[3];
  const double (*B)[3] = tet.inverse_edges;
  const Real volume(tet.volume);
  for (int r = 0; r < 3; ++r) {
    const Real p0 = P[r][0] * volume;
    const Real p1 = P[r][1] * volume;
    const Real p2 = P[r][2] * volume;
    const Real f1 = p0 * B[0][0] + p1 * B[0][1] + p2 * B[0][2];
    const Real f2 = p0 * B[1][0] + p1 * B[1][1] + p2 * B[1][2];
    const Real f3 = p0 * B[2][0] + p1 * B[2][1] + p2 * B[2][2];
    g0[r] -= f1 + f2 + f3;
    g1[r] += f1;
    g2[r] += f2;
    g3[r] += f3;
  }
}

/// Energy of one element at displacements u; adds its gradient to `gradient`.
template <class Real>
inline Real stvk_energy_and_gradient(const StVK& material, const RestTet& tet, const Real* u,
                                     Real* gradient) {
  Real G[3][3], S[3][3], P[3][3];
  displacement_gradient(tet, u, G);
  const Real density = stress(material, G, S);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      P[r][c] = S[r][c] + G[r][0] * S[0][c] + G[r][1] * S[1][c] + G[r][2] * S[2][c];  // F S
  scatter_stress(tet, P, gradient);
  return density * Real(tet.volume);
}

/// Differential dP = dF S + F dS of the first Piola-Kirchhoff stress at G with stress S, along dF.
template <class Real>
inline void stress_differential(const StVK& material, const Real G[3][3], const Real S[3][3],
                                const Real dF[3][3], Real dP[3][3]) {
  Real dS[3][3];
  Real FtdF[3][3];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      FtdF[r][c] = dF[r][c] + G[0][r] * dF[0][c] + G[1][r] * dF[1][c] + G[2][r] * dF[2][c];
  const Real pressure = (FtdF[0][0] + FtdF[1][1] + FtdF[2][2]) * Real(material.lam);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) dS[r][c] = (FtdF[r][c] + FtdF[c][r]) * Real(material.mu);
  for (int r = 0; r < 3; ++r) dS[r][r] += pressure;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      dP[r][c] = dF[r][0] * S[0][c] + dF[r][1] * S[1][c] + dF[r][2] * S[2][c] + dS[r][c] +
                 G[r][0] * dS[0][c] + G[r][1] * dS[1][c] + G[r][2] * dS[2][c];
}

/// Adds H v of one element at displacements u to `product`.
template <class Real>
inline void stvk_hessian_product(const StVK& material, const RestTet& tet, const Real* u,
                                 const Real* v, Real* product) {
  Real G[3][3], S[3][3], dF[3][3], dP[3][3];
  displacement_gradient(tet, u, G);
  displacement_gradient(tet, v, dF);
  stress(material, G, S);
  stress_differential(material, G, S, dF, dP);
  scatter_stress(tet, dP, product);
}

}  // namespace snapspace
