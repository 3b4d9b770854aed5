#include <optional>

#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "energy/block_hessian.h"
#include "energy/elastic_energy.h"
#include "energy/shell_poses.h"
#include "lanes/in_lanes.h"
#include "mesh/star_hats.h"

namespace snapspace {

namespace {

RestShape rest_shape(const MatrixIn& vertices, const IndexMatrixIn& tets, bool shell) {
  require(vertices.shape(1) == 3, "vertices must be (n, 3)");
  require(tets.shape(1) == 4, "tets must be (m, 4)");
  const auto n = static_cast<std::int32_t>(vertices.shape(0));
  require_below(tets, vertices.shape(0), "a tet has a vertex index out of range");
  return {vertices.data(), n, tets.data(), static_cast<int>(tets.shape(0)), shell};
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

std::pair<DoublesOut, DoublesOut> in_lanes(const ElasticEnergy& self, const MatrixIn& shapes,
                                           bool single) {
  const Packing packing = single ? Packing::single_lanes : Packing::lanes;
  const std::size_t count = shapes.shape(0), n = size(self);
  require(count <= static_cast<std::size_t>(samples_together(packing)) && shapes.shape(1) == n,
          "needs (k, 3n) with k at most the number of lanes");
  DoublesOut values = new_array<double>({count}), gradients = new_array<double>({count, n});
  {
    const ReleasedGil released;
    energies_in_lanes(self, packing, count, shapes.data(), values.data(), gradients.data());
  }
  return {values, gradients};
}

void bind_star_hats(nb::module_& m) {
  nb::class_<StarHats>(m, "StarHats",
                       "Weights of the vertices in the stars of a surface. They sum to one at "
                       "every vertex.")
      .def("__len__", &StarHats::count)
      .def(
          "rows",
          [](const StarHats& self) {
            return std::make_tuple(copy_to_array(self.first.data(), {self.first.size()}),
                                   copy_to_array(self.vertices.data(), {self.vertices.size()}),
                                   copy_to_array(self.weights.data(), {self.weights.size()}));
          },
          "Starts of the rows (s + 1,), vertices (w,) and weights (w,). The first vertex of a row "
          "is the center of the star.")
      .def("__getstate__",
           [](const StarHats& self) {
             return std::make_tuple(self.first, self.vertices, self.weights);
           })
      .def("__setstate__",
           [](StarHats& self, const std::tuple<std::vector<std::int32_t>, std::vector<std::int32_t>,
                                               std::vector<double>>& rows) {
             new (&self) StarHats{std::get<0>(rows), std::get<1>(rows), std::get<2>(rows)};
           });
  m.def(
      "star_hats",
      [](TensorIn shapes, IndexMatrixIn triangles, double radius) {
        require(shapes.shape(0) >= 1 && shapes.shape(2) == 3 && triangles.shape(1) == 3,
                "needs shapes (k, n, 3) and triangles (m, 3)");
        require_below(triangles, shapes.shape(1), "a triangle has a vertex index out of range");
        const ReleasedGil released;
        return star_hats(EdgeGraph(shapes.data(), static_cast<int>(shapes.shape(0)),
                                   static_cast<int>(shapes.shape(1)), triangles.data(),
                                   static_cast<int>(triangles.shape(0)), 3),
                         radius);
      },
      nb::arg("shapes"), nb::arg("triangles").noconvert(), nb::arg("radius"),
      "Stars of a surface. Their centers are at least a radius apart along edges, and every vertex "
      "is less than a radius from a center.");
}

void bind_material(nb::module_& m) {
  nb::class_<MaterialField>(m, "Material",
                            "An energy density, given by its name, and its moduli: one row (1, k), "
                            "or one row per tet.")
      .def(
          "__init__",
          [](MaterialField* self, const std::string& kind, MatrixIn moduli,
             const std::optional<StarHats>& hats) {
            new (self) MaterialField(kind.c_str(), {moduli.data(), moduli.data() + moduli.size()},
                                     static_cast<int>(moduli.shape(0)), hats.value_or(StarHats()));
          },
          nb::arg("kind"), nb::arg("moduli"), nb::arg("hats") = nb::none())
      .def_prop_ro("kind", &MaterialField::name)
      .def_prop_ro("rows", &MaterialField::rows);
  m.def(
      "material_moduli",
      [] {
        nb::typed<nb::dict, std::string, std::vector<std::string>> result;
        for (int kind = 0; kind < Densities::kCount; ++kind) {
          if (is_of_shells(kind)) continue;
          std::vector<std::string> names;
          for (int k = 0; k < material_moduli(kind); ++k) names.emplace_back(modulus_name(kind, k));
          result[material_name(kind)] = nb::cast(names);
        }
        return result;
      },
      "Names of the moduli of every density of solids, in the order of the entries of a row.");
  m.def(
      "shell_moduli",
      [](TensorIn poses, IndexMatrixIn elements, const std::string& kind, MatrixIn moduli) {
        constexpr std::size_t kScaled = ShellStVK::kScaled, kCount = ShellStVK::kModuli;
        const std::size_t count = elements.shape(0);
        require(poses.shape(0) >= 1 && poses.shape(2) == 3 && elements.shape(1) == 4 &&
                    moduli.shape(0) == count && moduli.shape(1) == kScaled,
                "needs poses (k, n, 3), elements (m, 4) and moduli (m, 3)");
        require_below(elements, poses.shape(1), "an element has a vertex index out of range");
        const int index = material_index(kind.c_str());
        require(index >= 0 && is_of_shells(index), "needs a density of shells");
        std::vector<double> rows(kCount * count, 0.0);
        for (std::size_t e = 0; e < count; ++e)
          std::copy_n(moduli.data() + kScaled * e, kScaled, rows.data() + kCount * e);
        const std::vector<MaterialField> materials = shell_pose_materials(
            poses.data(), static_cast<int>(poses.shape(0)), static_cast<int>(poses.shape(1)),
            elements.data(), static_cast<int>(count),
            {kind.c_str(), std::move(rows), static_cast<int>(count)});
        DoublesOut result = new_array<double>({poses.shape(0), count, kCount});
        for (std::size_t k = 0; k < materials.size(); ++k)
          std::copy_n(materials[k].view().moduli, kCount * count,
                      result.data() + k * kCount * count);
        return result;
      },
      nb::arg("poses"), nb::arg("elements").noconvert(), nb::arg("kind"), nb::arg("moduli"),
      "Rows of a shell's density (k, m, 15) with each of several poses (k, n, 3) as the rest "
      "shape. A row has the element's mu, lam and bending from `moduli` (m, 3), and then the "
      "numbers that describe its rest shape.");
  nb::enum_<Projection>(m, "Projection", "How Newton's method projects the Hessian of a tet.")
      .value("none", Projection::none)
      .value("stretches", Projection::stretches)
      .value("clamp", Projection::clamp)
      .value("absolute", Projection::absolute);
}

}  // namespace

void bind_energy(nb::module_& m) {
  bind_star_hats(m);
  bind_material(m);
  nb::class_<ElasticEnergy>(
      m, "ElasticEnergy",
      "Elastic energy of a mesh as a function of displacements u (3n,) from rest.")
      .def(
          "__init__",
          [](ElasticEnergy* self, MatrixIn vertices, IndexMatrixIn tets,
             const MaterialField& material) {
            const bool shell = is_of_shells(material.view().kind);
            new (self) ElasticEnergy(rest_shape(vertices, tets, shell), material);
          },
          nb::arg("vertices"), nb::arg("tets").noconvert(), nb::arg("material"))
      .def(
          "value_and_gradient",
          [](const ElasticEnergy& self, VectorIn u) {
            DoublesOut gradient = new_array<double>({size(self)});
            const double* displacement = checked(self, u);
            const double value = [&] {
              const ReleasedGil released;
              return self.value_and_gradient(displacement, gradient.data());
            }();
            return std::make_pair(value, gradient);
          },
          nb::arg("u"), "Energy and its gradient (3n,).")
      .def(
          "tet_stresses",
          [](const ElasticEnergy& self, VectorIn u) {
            const auto elements = static_cast<std::size_t>(self.elements());
            DoublesOut stresses = new_array<double>({elements, 9}),
                       energies = new_array<double>({elements});
            const double* displacement = checked(self, u);
            {
              const ReleasedGil released;
              self.tet_stresses(displacement, stresses.data(), energies.data());
            }
            return std::make_pair(stresses, energies);
          },
          nb::arg("u"),
          "Volume times first Piola-Kirchhoff stress (m, 9) and energy (m,) of each element: a "
          "tet, a triangle or a hinge, or the star of a vertex.")
      .def(
          "some_tet_stresses",
          [](const ElasticEnergy& self, VectorIn u, IndexVectorIn which) {
            const std::vector<std::int32_t> some(which.data(), which.data() + which.size());
            for (const std::int32_t element : some)
              require(element >= 0 && element < self.elements(), "an element is not in the mesh");
            DoublesOut stresses = new_array<double>({some.size(), 9}),
                       energies = new_array<double>({some.size()});
            const double* displacement = checked(self, u);
            {
              const ReleasedGil released;
              self.tet_stresses(some, displacement, stresses.data(), energies.data());
            }
            return std::make_pair(stresses, energies);
          },
          nb::arg("u"), nb::arg("which"),
          "`tet_stresses` for some elements (c,): stresses (c, 9) "
          "and energies (c,).")
      .def(
          "stars",
          [](const ElasticEnergy& self) {
            require(self.stars.has_value(), "the material has no stars");
            return *self.stars;
          },
          "The stars of an as-rigid-as-possible surface.")
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
          [](const ElasticEnergy& self, VectorIn u, Projection projection, double threshold) {
            BlockHessian hessian(self);
            hessian.add(self, checked(self, u), projection, threshold);
            return blocks_of(hessian);
          },
          nb::arg("u"), nb::kw_only(), nb::arg("projection") = Projection::none,
          nb::arg("threshold") = 0.0,
          "Hessian at u, projected tet by tet, as block rows: (row_start (n+1,), columns (b,), "
          "blocks (b,3,3)). Only Projection.stretches uses the threshold.")
      .def("lane_values_and_gradients", &in_lanes, nb::arg("shapes"), nb::kw_only(),
           nb::arg("single") = false,
           "Energies (k,) and gradients (k, 3n) at up to lane_count displacements (k, 3n), one per "
           "lane; twice as many in single precision.")
      .def(
          "scalar_diagonal",
          [](const ElasticEnergy& self) {
            const Eigen::VectorXd diagonal = self.scalar_matrix().diagonal();
            return copy_to_array(diagonal.data(), {static_cast<std::size_t>(diagonal.size())});
          },
          "Diagonal (n,) of the scalar matrix that replaces the Hessian for each of x, y and z.")
      .def(
          "inverted_tets",
          [](const ElasticEnergy& self, VectorIn u) {
            return self.inverted_tets(checked(self, u));
          },
          nb::arg("u"), "Number of elements with det F <= 0.");
}

}  // namespace snapspace
