#pragma once
#include "element/rest_shell.h"
#include "material/materials.h"

namespace snapspace {

/// Sets the numbers of a shell's density that belong to the rest shape of an element.
/// @param kind     the density, one of shells
/// @param product  for a hinge, four times the product of both areas at which bending has its full
///                 stiffness
/// @param numbers  material_moduli(kind), with the moduli first
inline void set_rest_shape(int kind, const double* vertices, const std::int32_t corners[4],
                           double product, double* numbers) {
  const RestShellElement element(vertices, corners);
  element.write_numbers(numbers + scaled_moduli(kind), product);
  if (!is_triangle(corners)) set_rest_angle(kind, element.half_angle_tangent(), numbers);
}

}  // namespace snapspace
