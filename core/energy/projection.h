#pragma once
#include "material/principal_curvature.h"

namespace snapspace {

/// The matrix that Newton's method uses for the Hessian of a tet, which may be indefinite.
enum class Projection : int {
  none = 0,       ///< the Hessian itself
  stretches = 1,  ///< the Hessian after signed singular values are raised to a threshold
                  ///< [Irving, Teran, Fedkiw 2004; paper, sec. 4.2]; not always definite
  clamp = 2,      ///< negative eigenvalues become zero [Teran, Sifakis, Irving, Fedkiw 2005]
  absolute = 3,   ///< negative eigenvalues change sign [Chen et al. 2024]
};

/// The curvature with its negative eigenvalues, of nine, set to zero by `clamp` or made positive by
/// `absolute`; other projections do not change it. With `clamp` it is the nearest semi-definite
/// one, since the frame is orthonormal.
[[nodiscard]] PrincipalCurvature projected(PrincipalCurvature curvature, Projection projection);

/// Projects the Hessian of an element of a shell, which has no principal axes. `stretches` counts
/// as `clamp`.
void project(double (&hessian)[9][9], Projection projection);

}  // namespace snapspace
