#pragma once
#include <cmath>

#include "element/rest_tet.h"

namespace snapspace {

/// The tet between four rows of `vertices` (n x 3). Its volume must not vanish.
inline RestTet make_rest_tet(const double* vertices, const std::int32_t corners[4]) {
  double e[3][3];  // edges from the first corner
  for (int j = 0; j < 3; ++j)
    for (int a = 0; a < 3; ++a)
      e[j][a] = vertices[3 * corners[j + 1] + a] - vertices[3 * corners[0] + a];
  RestTet tet;
  for (int j = 0; j < 3; ++j) {
    const double *p = e[(j + 1) % 3], *q = e[(j + 2) % 3];
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      tet.inverse_edges[j][a] = p[b] * q[c] - p[c] * q[b];
    }
  }
  const double* n = tet.inverse_edges[0];
  const double determinant = e[0][0] * n[0] + e[0][1] * n[1] + e[0][2] * n[2];
  for (auto& row : tet.inverse_edges)
    for (double& entry : row) entry /= determinant;
  tet.volume = std::abs(determinant) / 6.0;
  for (int corner = 0; corner < 4; ++corner) tet.vertices[corner] = corners[corner];
  return tet;
}

}  // namespace snapspace
