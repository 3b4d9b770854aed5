#pragma once
#include "material/tet_material.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// Energies and stresses of tets, one per lane, for the density at an index of Densities. The cost
/// of the switch is negligible beside the rows of the tets, and all callers share the code.
/// @param moduli  times the volumes that the tets represent
[[nodiscard]] TetRows::Tets value_and_stress(int kind, const TetRows::Tets* moduli,
                                             const TetRows::Tets G[3][3], TetRows::Tets P[3][3]);

}  // namespace snapspace::online
