#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "element/make_rest_element.h"
#include "material/shell_rest.h"
#include "material/tet_material.h"

/// Elements of a shell from their corners (4 x 3) and three moduli: mu > 0, lam, 0 for a triangle;
/// 0, 0, bending for a hinge.
namespace snapspace::online {

inline constexpr std::int32_t kHingeCorners[4] = {0, 1, 2, 3};
inline constexpr std::int32_t kTriangleCorners[4] = {0, 1, 2, 2};

[[nodiscard]] inline const std::int32_t* corners_of(const double* moduli) {
  return moduli[0] > 0.0 ? kTriangleCorners : kHingeCorners;
}

[[nodiscard]] inline RestShellElement shell_element(const double* moduli, const double* points) {
  return {points, corners_of(moduli)};
}

/// Rows of a ShellDensity: the moduli, and the numbers of the rest shapes.
/// @param area_products  of hinges, at which bending has its full stiffness; null for those at rest
/// @param rows           elements x moduli of the density at `kind`, overwritten
inline void shell_moduli(int kind, int elements, const double* points, const double* moduli,
                         const double* area_products, double* rows) {
  const int count = material_moduli(kind), scaled = scaled_moduli(kind);
  std::fill_n(rows, static_cast<std::size_t>(count) * static_cast<std::size_t>(elements), 0.0);
  for (int e = 0; e < elements; ++e, points += 12, moduli += scaled, rows += count) {
    std::copy_n(moduli, scaled, rows);
    const double product =
        area_products ? area_products[e] : shell_element(moduli, points).area_product();
    set_rest_shape(kind, points, corners_of(moduli), product, rows);
  }
}

}  // namespace snapspace::online
