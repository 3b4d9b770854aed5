#include "bindings/arrays.h"
#include "energy/vertex_stars.h"
#include "material/shell_arap.h"

namespace snapspace {

void bind_stars(nb::module_& m) {
  nb::class_<VertexStars>(m, "VertexStars",
                          "The stars of a surface: the elements of its ARAP "
                          "energy.")
      .def(
          "corners",
          [](const VertexStars& self) {
            return std::make_tuple(
                copy_to_array(self.first_corner.data(), {self.first_corner.size()}),
                copy_to_array(self.corners.data(), {self.corners.size()}),
                copy_to_array(self.gradients.data(), {self.corners.size(), 3}));
          },
          "First corners (s + 1,), vertices (c,) and gradients (c, 3). The displacement gradient "
          "of a star is the sum of u (x) gradient over its corners.")
      .def(
          "triangles",
          [](const VertexStars& self) {
            return std::make_tuple(
                copy_to_array(self.first_triangle.data(), {self.first_triangle.size()}),
                copy_to_array(self.triangles.data(), {self.triangles.size()}),
                copy_to_array(self.shares.data(), {self.shares.size()}));
          },
          "First triangles (s + 1,), triangles (t,) and shares (t,). A triangle's weight in a star "
          "is its share times a third of its area times its modulus.")
      .def(
          "numbers",
          [](const VertexStars& self) {
            constexpr std::size_t kCount = ShellArap::kModuli;
            const auto count = static_cast<std::size_t>(self.count());
            DoublesOut rows = new_array<double>({count, kCount});
            for (std::size_t star = 0; star < count; ++star)
              self.write_numbers(static_cast<int>(star), rows.data() + kCount * star);
            return rows;
          },
          "Rows of the density \"shell-arap\" (s, 12), with modulus one.")
      .def(
          "areas",
          [](const VertexStars& self) {
            return copy_to_array(self.areas.data(), {self.areas.size()});
          },
          "Sums of the hats times a third of the area around each vertex, (s,).")
      .def(
          "weights",
          [](const VertexStars& self) {
            return copy_to_array(self.weights.data(), {self.weights.size()});
          },
          "The same sums with areas times moduli, (s,).")
      .def(
          "couplings",
          [](const VertexStars& self) {
            return std::make_tuple(
                copy_to_array(self.first_neighbour.data(), {self.first_neighbour.size()}),
                copy_to_array(self.neighbours.data(), {self.neighbours.size()}),
                copy_to_array(self.couplings.data(), {self.couplings.size()}));
          },
          "First neighbours (n + 1,), vertices (e,) and couplings (e,). The Dirichlet energy is "
          "the sum of coupling * u_i . (u_j - u_i) over all vertices and their neighbours.");
}

}  // namespace snapspace
