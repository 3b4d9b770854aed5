#pragma once
#include "material/principal_curvature.h"
#include "material/signed_svd.h"

namespace snapspace {

/// The Hessian of an isotropic density at F = U diag(s) V^T, as a map of dF to dP.
struct PrincipalMap {
  SignedSvd frame;
  PrincipalCurvature curvature;

  /// dP = U H(U^T dF V) V^T
  void multiply(const double dF[3][3], double dP[3][3]) const {
    double half[3][3], local[3][3], image[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        half[r][c] = frame.U[0][r] * dF[0][c] + frame.U[1][r] * dF[1][c] + frame.U[2][r] * dF[2][c];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        local[r][c] =
            half[r][0] * frame.V[0][c] + half[r][1] * frame.V[1][c] + half[r][2] * frame.V[2][c];
    for (int i = 0; i < 3; ++i) {
      image[i][i] = curvature.scaling[i][0] * local[0][0] + curvature.scaling[i][1] * local[1][1] +
                    curvature.scaling[i][2] * local[2][2];
      const int j = kPairs[i][0], k = kPairs[i][1];
      image[j][k] = curvature.same(i) * local[j][k] + curvature.cross(i) * local[k][j];
      image[k][j] = curvature.same(i) * local[k][j] + curvature.cross(i) * local[j][k];
    }
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        half[r][c] =
            frame.U[r][0] * image[0][c] + frame.U[r][1] * image[1][c] + frame.U[r][2] * image[2][c];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        dP[r][c] =
            half[r][0] * frame.V[c][0] + half[r][1] * frame.V[c][1] + half[r][2] * frame.V[c][2];
  }
};

}  // namespace snapspace
