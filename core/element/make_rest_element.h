#pragma once
#include "element/make_rest_tet.h"
#include "element/rest_shell.h"

namespace snapspace {

/// The element between four rows of `vertices` (n x 3): a tet of a solid, or a triangle or a hinge
/// of a shell. No tet may be without volume, and no triangle without area.
inline RestTet make_rest_element(bool shell, const double* vertices,
                                 const std::int32_t corners[4]) {
  return shell ? RestShellElement(vertices, corners).element() : make_rest_tet(vertices, corners);
}

}  // namespace snapspace
