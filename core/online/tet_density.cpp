#include "online/tet_density.h"

namespace snapspace::online {

TetRows::Tets value_and_stress(int kind, const TetRows::Tets* moduli, const TetRows::Tets G[3][3],
                               TetRows::Tets P[3][3]) {
  return Densities::with(kind,
                         [&]<class Density>() { return Density::value_and_stress(moduli, G, P); });
}

}  // namespace snapspace::online
