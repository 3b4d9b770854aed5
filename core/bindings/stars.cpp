#include "bindings/arrays.h"
#include "energy/vertex_stars.h"
#include "material/shell_arap.h"

namespace snapspace {

void bind_stars(nb::module_& m) {
  nb::class_<VertexStars>(m, "VertexStars",
                          "The stars of a surface's vertices, elements of its ARAP energy.")
      .def(
          "corners",
          [](const VertexStars& self) {
            return std::make_tuple(
                copy_to_array(self.first_corner.data(), {self.first_corner.size()}),
                copy_to_array(self.corners.data(), {self.corners.size()}),
                copy_to_array(self.gradients.data(), {self.corners.size(), 3}));
          },
          "First corners (n + 1,), vertices (c,) and gradients (c, 3): the gradient of a star is "
          "the sum of u (x) gradient over its corners.")
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
          "Rows of the density \"shell-arap\" (n, 12), of modulus one.")
      .def(
          "areas",
          [](const VertexStars& self) {
            return copy_to_array(self.areas.data(), {self.areas.size()});
          },
          "A third of the area around each vertex, (n,).")
      .def(
          "weights",
          [](const VertexStars& self) {
            return copy_to_array(self.weights.data(), {self.weights.size()});
          },
          "The same of areas times moduli, (n,).")
      .def(
          "remainder",
          [](const VertexStars& self) {
            const Eigen::SparseMatrix<double> Q = self.remainder();
            const auto size = static_cast<std::size_t>(Q.cols()) + 1;
            const auto entries = static_cast<std::size_t>(Q.nonZeros());
            return std::make_tuple(copy_to_array(Q.outerIndexPtr(), {size}),
                                   copy_to_array(Q.innerIndexPtr(), {entries}),
                                   copy_to_array(Q.valuePtr(), {entries}));
          },
          "The quadratic part of the energy: a symmetric matrix (n, n), row by row.");
}

}  // namespace snapspace
