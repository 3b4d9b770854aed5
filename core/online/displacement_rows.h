#pragma once
#include <cstddef>
#include <cstdint>

#include "online/shell_elements.h"

namespace snapspace::online {

/// Displacement gradients of modes in some tets: entry 3 a + b of the second index of `rows` is d
/// u_a / d x_b. Differences of nodal values are taken first: sums over all four corners would lose
/// digits on slivers.
/// @param points  tets x 4 x 3, the corners at rest; no tet without volume
/// @param modes  tets x 4 x 3 x dimension, displacements of the corners
/// @param shell  elements x 3, if they are those of a shell, see shell_elements.h; else null
/// @param rows  tets x 9 x dimension, overwritten
inline void displacement_rows(int tets, int dimension, const double* points, const double* modes,
                              const double* shell, float* rows) {
  const auto d = static_cast<std::size_t>(dimension);
  for (int t = 0; t < tets; ++t, points += 12, modes += 12 * d) {
    const RestTet tet = shell ? shell_element(shell + 3 * t, points).element()
                              : make_rest_tet(points, kHingeCorners);
    for (int entry = 0; entry < 9; ++entry, rows += d) {
      const int a = entry / 3, b = entry % 3;
      const double* origin = modes + a * d;
      const double g1 = tet.inverse_edges[0][b], g2 = tet.inverse_edges[1][b],
                   g3 = tet.inverse_edges[2][b];
      for (std::size_t i = 0; i < d; ++i) {
        const double u0 = origin[i];
        rows[i] = static_cast<float>((origin[3 * d + i] - u0) * g1 + (origin[6 * d + i] - u0) * g2 +
                                     (origin[9 * d + i] - u0) * g3);
      }
    }
  }
}

}  // namespace snapspace::online
