#pragma once
#include <cstdint>
#include <vector>

#include "energy/material_field.h"

namespace snapspace {

/// Densities of a shell's elements with each of several poses as the rest shape. The moduli are the
/// same in all poses, and so is the product of areas at which a hinge has its full stiffness: the
/// geometric mean of the products in all poses.
/// @param poses   count x n x 3   @param elements  m x 4, triangles and hinges
/// @param field  of the elements; only its moduli and its hats are read, not its numbers of the
/// rest shape
[[nodiscard]] std::vector<MaterialField> shell_pose_materials(const double* poses, int count,
                                                              int vertex_count,
                                                              const std::int32_t* elements,
                                                              int element_count,
                                                              const MaterialField& field);

}  // namespace snapspace
