#pragma once
#include "material/principal_curvature.h"

namespace snapspace {

/// What Newton's method takes for the Hessian of a tet, which may be indefinite.
enum class Projection : int {
  none = 0,       ///< the Hessian itself
  stretches = 1,  ///< that of the state whose signed singular values are raised to a threshold
                  ///< [Irving, Teran, Fedkiw 2004; paper, sec. 4.2]; not always definite
  clamp = 2,      ///< negative eigenvalues become zero [Teran, Sifakis, Irving, Fedkiw 2005]
  absolute = 3,   ///< negative eigenvalues change their sign [Chen et al. 2024]
};

/// The curvature with its nine eigenvalues made zero or positive as `clamp` and `absolute` say; no
/// other projection changes it. The nearest semi-definite one, since the frame is orthonormal.
[[nodiscard]] PrincipalCurvature projected(PrincipalCurvature curvature, Projection projection);

}  // namespace snapspace
