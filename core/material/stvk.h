#pragma once
/// St.Venant-Kirchhoff material at a point. Real is double, or Lanes for one sample or tet per
/// lane.
///
/// Strain E = (F^T F - I) / 2, density psi = mu |E|^2 + lam/2 tr(E)^2 [Bonet & Wood 2007]. All is
/// told in the displacement gradient G = F - I: the strain E = (G + G^T + G^T G) / 2 keeps full
/// precision for small deformations and on slivers, where F^T F - I cancels. St.VK cannot tell an
/// inverted element from its mirror image: psi(F) = psi(-F).
namespace snapspace {

struct StVK {
  double lam;
  double mu;
};

/// Upper triangle of the strain E = (G + G^T + G^T G) / 2.
template <class Real>
inline void strain(const Real G[3][3], Real E[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int c = r; c < 3; ++c) {
      const Real quadratic = G[0][r] * G[0][c] + G[1][r] * G[1][c] + G[2][r] * G[2][c];
      E[r][c] = (G[r][c] + G[c][r] + quadratic) * Real(0.5);
    }
}

/// Second Piola-Kirchhoff stress S = 2 mu E + lam tr(E) I of a strain given by its upper triangle;
/// returns the density psi.
template <class Real>
inline Real stress_of_strain(const StVK& material, const Real E[3][3], Real S[3][3]) {
  const Real trace = E[0][0] + E[1][1] + E[2][2];
  const Real pressure = trace * Real(material.lam);
  const Real two_mu(2.0 * material.mu);
  for (int r = 0; r < 3; ++r) {
    S[r][r] = E[r][r] * two_mu + pressure;
    for (int c = r + 1; c < 3; ++c) S[r][c] = S[c][r] = E[r][c] * two_mu;
  }
  // psi = S : E / 2, quadratic in E
  const Real diagonal = S[0][0] * E[0][0] + S[1][1] * E[1][1] + S[2][2] * E[2][2];
  return diagonal * Real(0.5) + (S[0][1] * E[0][1] + S[0][2] * E[0][2] + S[1][2] * E[1][2]);
}

/// The same at G.
template <class Real>
inline Real stress(const StVK& material, const Real G[3][3], Real S[3][3]) {
  Real E[3][3];
  strain(G, E);
  return stress_of_strain(material, E, S);
}

/// The same at G, both times the volume whose products with lambda and mu are given: a pass over a
/// mesh does little else, so it has its own arithmetic with a sixth fewer operations.
template <class Real>
inline Real volume_stress(Real lam, Real mu, const Real G[3][3], Real S[3][3]) {
  Real E2[3][3];  // 2 E
  for (int r = 0; r < 3; ++r)
    for (int c = r; c < 3; ++c)
      E2[r][c] = G[r][c] + G[c][r] + G[0][r] * G[0][c] + G[1][r] * G[1][c] + G[2][r] * G[2][c];
  const Real pressure = (E2[0][0] + E2[1][1] + E2[2][2]) * (lam * Real(0.5));
  for (int r = 0; r < 3; ++r) {
    S[r][r] = E2[r][r] * mu + pressure;
    for (int c = r + 1; c < 3; ++c) S[r][c] = S[c][r] = E2[r][c] * mu;
  }
  const Real diagonal = S[0][0] * E2[0][0] + S[1][1] * E2[1][1] + S[2][2] * E2[2][2];
  const Real others = S[0][1] * E2[0][1] + S[0][2] * E2[0][2] + S[1][2] * E2[1][2];
  return diagonal * Real(0.25) + others * Real(0.5);
}

/// First Piola-Kirchhoff stress P = F S at G with second stress S.
template <class Real>
inline void first_stress(const Real G[3][3], const Real S[3][3], Real P[3][3]) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      P[r][c] = S[r][c] + G[r][0] * S[0][c] + G[r][1] * S[1][c] + G[r][2] * S[2][c];
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

}  // namespace snapspace
