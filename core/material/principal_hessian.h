#pragma once
#include "material/principal_map.h"
#include "material/tet_material.h"

namespace snapspace {

/// The Hessian of a density at a displacement gradient, as a map of dF to dP.
struct PrincipalHessian : PrincipalMap {
  PrincipalHessian(const TetMaterial& material, int tet, const double G[3][3])
      : PrincipalMap{deformation_gradient(G), {}} {
    curvature = material.curvature(tet, frame.s);
  }

 private:
  static SignedSvd deformation_gradient(const double G[3][3]) {
    double F[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) F[r][c] = r == c ? 1.0 + G[r][c] : G[r][c];
    return SignedSvd(F);
  }
};

}  // namespace snapspace
