#pragma once
namespace snapspace {

/// Second derivatives of an isotropic density at F = U diag(s) V^T, in the frame of U and V.
/// With g = d psi / d s, the Hessian with respect to U^T dF V decouples [Smith, de Goes, Kim 2019,
/// "Analytic Eigensystems for Isotropic Distortion Energies"] into the 3 x 3 Hessian with respect
/// to s on the diagonal entries and, for each pair i < j of axes, one value on the twist (e_i e_j^T
/// - e_j e_i^T) / sqrt 2 and one on the flip (e_i e_j^T + e_j e_i^T) / sqrt 2.
struct PrincipalCurvature {
  double scaling[3][3];  ///< d^2 psi / d s_i d s_j, symmetric
  double twist[3];       ///< (g_i + g_j) / (s_i + s_j) of the two axes other than this index
  double flip[3];        ///< (g_i - g_j) / (s_i - s_j), or its limit

  /// Second derivative with respect to an off-diagonal entry of U^T dF V, and the mixed one with
  /// respect to the entry and its transpose.
  [[nodiscard]] double same(int without) const { return 0.5 * (flip[without] + twist[without]); }
  [[nodiscard]] double cross(int without) const { return 0.5 * (flip[without] - twist[without]); }
};

/// The two axes other than a given one.
inline constexpr int kPairs[3][2] = {{1, 2}, {2, 0}, {0, 1}};

}  // namespace snapspace
