#pragma once
#include "material/materials.h"

namespace snapspace {

/// The material of some tets: a density and its moduli, the same for all tets or tet by tet. A
/// view: it does not own the moduli.
struct TetMaterial {
  int kind;              ///< index among Densities
  int rows;              ///< 1, or the number of tets
  const double* moduli;  ///< rows x material_moduli(kind)

  [[nodiscard]] const double* of(int tet) const {
    return moduli + static_cast<long>(rows == 1 ? 0 : tet) * material_moduli(kind);
  }
  [[nodiscard]] Lame small_strains(int tet) const {
    return Densities::with(kind, [&]<class Density>() { return Density::small_strains(of(tet)); });
  }
  /// Not for shells.
  /// @param s  signed singular values of F
  [[nodiscard]] PrincipalCurvature curvature(int tet, const double s[3]) const {
    return Densities::with(kind, [&]<class Density>() {
      if constexpr (kOfShells<Density>)
        return PrincipalCurvature{};
      else
        return Density::curvature(of(tet), s);
    });
  }
};

}  // namespace snapspace
