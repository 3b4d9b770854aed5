#pragma once
#include <cstdint>

namespace snapspace {

/// What a tetrahedron's energy needs of its rest shape, in double or single precision.
template <class T>
struct RestTetOf {
  T inverse_edges[3][3];  ///< inverse of the matrix with columns v1 - v0, v2 - v0, v3 - v0
  T volume;               ///< positive, also where the tet is inverted in its rest shape
  std::int32_t vertices[4];
};
using RestTet = RestTetOf<double>;

}  // namespace snapspace
