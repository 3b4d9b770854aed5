#include "bindings/arrays.h"
#include "energy/block_hessian.h"
#include "energy/elastic_energy.h"

namespace snapspace {

namespace {

RestShape rest_shape(const MatrixIn& vertices, const IndexMatrixIn& tets) {
  require(vertices.shape(1) == 3, "vertices must be (n, 3)");
  require(tets.shape(1) == 4, "tets must be (m, 4)");
  const auto n = static_cast<std::int32_t>(vertices.shape(0));
  require_below(tets, vertices.shape(0), "a tet has a vertex index out of range");
  return {vertices.data(), n, tets.data(), static_cast<int>(tets.shape(0))};
}

std::size_t size(const ElasticEnergy& energy) {
  return 3 * static_cast<std::size_t>(energy.rest.vertex_count);
}

const double* checked(const ElasticEnergy& energy, const VectorIn& u) {
  require(u.size() == size(energy), "a shape vector must have 3 entries per vertex");
  return u.data();
}

std::tuple<IndicesOut, IndicesOut, DoublesOut> blocks_of(const BlockHessian& hessian) {
  const std::size_t count = hessian.columns().size();
  return {copy_to_array(hessian.row_start().data(), {hessian.row_start().size()}),
          copy_to_array(hessian.columns().data(), {count}),
          copy_to_array(hessian.blocks().data()->data(), {count, 3, 3})};
}

}  // namespace

void bind_energy(nb::module_& m) {
  nb::class_<ElasticEnergy>(
      m, "ElasticEnergy",
      "St.Venant-Kirchhoff energy of a mesh as a function of displacements u (3n,) from rest.")
      .def(
          "__init__",
          [](ElasticEnergy* self, MatrixIn vertices, IndexMatrixIn tets, double lam, double mu) {
            new (self) ElasticEnergy{rest_shape(vertices, tets), StVK{lam, mu}};
          },
          nb::arg("vertices"), nb::arg("tets").noconvert(), nb::arg("lam"), nb::arg("mu"))
      .def(
          "value_and_gradient",
          [](const ElasticEnergy& self, VectorIn u) {
            DoublesOut gradient = new_array<double>({size(self)});
            const double value = self.value_and_gradient(checked(self, u), gradient.data());
            return std::make_pair(value, gradient);
          },
          nb::arg("u"), "Energy and its gradient (3n,).")
      .def(
          "tet_stresses",
          [](const ElasticEnergy& self, VectorIn u) {
            const std::size_t tets = self.rest.tets.size();
            DoublesOut stresses = new_array<double>({tets, 9}),
                       energies = new_array<double>({tets});
            self.tet_stresses(checked(self, u), stresses.data(), energies.data());
            return std::make_pair(stresses, energies);
          },
          nb::arg("u"),
          "Volume times first Piola-Kirchhoff stress of every tet (m, 9), and its energy (m,).")
      .def(
          "hessian_product",
          [](const ElasticEnergy& self, VectorIn u, VectorIn v) {
            DoublesOut product = new_array<double>({size(self)});
            self.hessian_product(checked(self, u), checked(self, v), product.data());
            return product;
          },
          nb::arg("u"), nb::arg("v"), "Hessian at u times v (3n,), without forming the Hessian.")
      .def(
          "hessian_blocks",
          [](const ElasticEnergy& self, VectorIn u) {
            BlockHessian hessian(self.rest);
            hessian.add(self, checked(self, u));
            return blocks_of(hessian);
          },
          nb::arg("u"),
          "Hessian at u as block rows: (row_start (n+1,), columns (b,), blocks (b,3,3)).")
      .def(
          "clamped_hessian_blocks",
          [](const ElasticEnergy& self, VectorIn u, double threshold) {
            BlockHessian hessian(self.rest);
            hessian.add(self, checked(self, u), threshold);
            return blocks_of(hessian);
          },
          nb::arg("u"), nb::arg("threshold"),
          "The same with every element at its signed singular values clamped to at least "
          "threshold.")
      .def(
          "inverted_tets",
          [](const ElasticEnergy& self, VectorIn u) {
            return self.inverted_tets(checked(self, u));
          },
          nb::arg("u"), "Number of elements with det F <= 0.");
}

}  // namespace snapspace
