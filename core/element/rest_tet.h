#pragma once
#include <cstdint>

namespace snapspace {

/// The part of a tet's rest shape that its energy needs, in double or single precision.
template <class T>
struct RestTetOf {
  T inverse_edges[3][3];  ///< inverse of the matrix with columns v1 - v0, v2 - v0, v3 - v0
  T volume;               ///< positive, even if the tet is inverted in its rest shape
  std::int32_t vertices[4];
};
using RestTet = RestTetOf<double>;

}  // namespace snapspace
