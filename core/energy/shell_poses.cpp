#include "energy/shell_poses.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "material/shell_rest.h"

namespace snapspace {

std::vector<MaterialField> shell_pose_materials(const double* poses, int count, int vertex_count,
                                                const std::int32_t* elements, int element_count,
                                                const MaterialField& field) {
  const TetMaterial material = field.view();
  const int width = material_moduli(material.kind), moduli = scaled_moduli(material.kind);
  const auto vertices_of = [&](int pose) {
    return poses + 3 * static_cast<std::size_t>(pose) * vertex_count;
  };
  const auto rest = [&](int pose, int e) {
    return RestShellElement(vertices_of(pose), elements + 4 * static_cast<std::size_t>(e));
  };
  std::vector<double> products(element_count, 0.0);
  for (int e = 0; e < element_count; ++e) {
    if (is_triangle(elements + 4 * static_cast<std::size_t>(e))) continue;
    double logarithms = 0.0;
    for (int k = 1; k < count; ++k)
      logarithms += std::log(rest(k, e).area_product() / rest(0, e).area_product());
    products[e] = rest(0, e).area_product() * std::exp(logarithms / count);
  }
  std::vector<MaterialField> result;
  for (int k = 0; k < count; ++k) {
    std::vector<double> rows(static_cast<std::size_t>(element_count) * width, 0.0);
    for (int e = 0; e < element_count; ++e) {
      double row[kMaxModuli] = {};  // the numbers of a rest triangle are more than ARAP needs
      std::copy_n(material.of(e), moduli, row);
      set_rest_shape(material.kind, vertices_of(k), elements + 4 * static_cast<std::size_t>(e),
                     products[e], row);
      std::copy_n(row, width, rows.data() + static_cast<std::size_t>(e) * width);
    }
    result.emplace_back(material_name(material.kind), std::move(rows), element_count, field.hats());
  }
  return result;
}

}  // namespace snapspace
