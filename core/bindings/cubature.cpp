#include "online/cubature.h"

#include "bindings/live_loop.h"
#include "energy/material_field.h"
#include "online/blended_cubature.h"
#include "online/blending_solver.h"
#include "online/posing_solver.h"

namespace snapspace {

namespace {

using online::Cubature;
using CubatureSolver = online::PosingSolver<Cubature>;
using CubatureLoop = Loop<CubatureSolver>;
using online::BlendedCubature;
using BlendedSolver = online::BlendingSolver<BlendedCubature>;
using BlendedLoop = Loop<BlendedSolver>;
using RowsIn = nb::ndarray<const float, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

Cubature make_cubature(const RowsIn& rows, const VectorIn& weights, const MaterialField& material) {
  require(rows.shape(0) >= 1 && rows.shape(1) == 9 && rows.shape(2) >= 1 &&
              weights.size() == rows.shape(0),
          "rows (tets, 9, d) and weights (tets,) do not match");
  require(material.fits(weights.size()), "the material has moduli for another number of tets");
  return {static_cast<int>(rows.shape(2)), static_cast<int>(rows.shape(0)), rows.data(),
          weights.data(), material.view()};
}

/// @param corners  (poses + 1, tets, 12): the tets in each pose, and at the mean shape
BlendedCubature make_blended(const RowsIn& rows, const VectorIn& weights,
                             const MaterialField& material, const TensorIn& corners) {
  require(rows.shape(0) >= 1 && rows.shape(1) == 9 && rows.shape(2) >= 1 &&
              weights.size() == rows.shape(0),
          "rows (tets, 9, d) and weights (tets,) do not match");
  require(material.fits(weights.size()), "the material has moduli for another number of tets");
  require(corners.shape(0) >= 2 && corners.shape(1) == weights.size() && corners.shape(2) == 12,
          "corners must be (poses + 1, tets, 12)");
  const std::size_t poses = corners.shape(0) - 1;
  const double* tau = corners.data() + poses * 12 * weights.size();
  return {static_cast<int>(rows.shape(2)),
          static_cast<int>(rows.shape(0)),
          rows.data(),
          weights.data(),
          material.view(),
          {static_cast<int>(poses), corners.data(), tau}};
}

void bind_blended(nb::module_& m) {
  nb::class_<BlendedCubature>(m, "BlendedCubature",
                              "Blended energy of several poses as a weighted sum over few tets.")
      .def(
          "__init__",
          [](BlendedCubature* self, RowsIn rows, VectorIn weights, const MaterialField& material,
             TensorIn corners) {
            new (self) BlendedCubature(make_blended(rows, weights, material, corners));
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("corners"))
      .def_prop_ro("dimension", &BlendedCubature::dimension)
      .def(
          "set_weights",
          [](BlendedCubature& self, VectorIn weights) {
            require(weights.size() == static_cast<std::size_t>(self.poses()),
                    "weights must have one entry per pose");
            self.set_weights(weights.data());
          },
          nb::arg("weights"))
      .def(
          "value_and_gradient",
          [](BlendedCubature& self, VectorIn q) { return value_and_gradient(self, q); },
          nb::arg("q"))
      .def(
          "derivatives", [](BlendedCubature& self, VectorIn q) { return derivatives(self, q); },
          nb::arg("q"), "Value, gradient and Hessian.");

  nb::class_<BlendedLoop> loop(m, "BlendedCubatureLoop",
                               "The live loop of blending with a cubature instead of quartics.");
  loop.def(
      "__init__",
      [](BlendedLoop* self, RowsIn rows, VectorIn weights, const MaterialField& material,
         TensorIn corners) {
        BlendedSolver solver(make_blended(rows, weights, material, corners));
        const auto d = static_cast<std::size_t>(solver.dimension());
        require_valid(
            solver,
            "the reduced Hessian at the mean shape is not positive definite; the cubature "
            "has too few tets");
        new (self) BlendedLoop{std::move(solver), std::vector<double>(d, 0.0)};
      },
      nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("corners"));
  bind_weights(loop);
  bind_loop(loop);
}

}  // namespace

void bind_cubature(nb::module_& m) {
  nb::class_<Cubature>(m, "Cubature", "Elastic energy as a weighted sum over few tets.")
      .def(
          "__init__",
          [](Cubature* self, RowsIn rows, VectorIn weights, const MaterialField& material) {
            new (self) Cubature(make_cubature(rows, weights, material));
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"))
      .def_prop_ro("dimension", &Cubature::dimension)
      .def(
          "value_and_gradient",
          [](Cubature& self, VectorIn q) { return value_and_gradient(self, q); }, nb::arg("q"))
      .def(
          "derivatives", [](Cubature& self, VectorIn q) { return derivatives(self, q); },
          nb::arg("q"), "Value, gradient and Hessian.");

  nb::class_<CubatureLoop> loop(m, "CubatureLoop",
                                "The live loop of posing with a cubature instead of a quartic.");
  loop.def(
      "__init__",
      [](CubatureLoop* self, RowsIn rows, VectorIn weights, const MaterialField& material,
         MatrixIn K, TensorIn L, TensorIn S) {
        Cubature elastic = make_cubature(rows, weights, material);
        const auto d = static_cast<std::size_t>(elastic.dimension());
        require(K.shape(0) == d && K.shape(1) == d && L.shape(1) == d && L.shape(2) == 12 &&
                    S.shape(0) == L.shape(0) && S.shape(1) == 4 && S.shape(2) == 4,
                "rows (tets, 9, d), K (d,d), L (h,d,12), S (h,4,4) do not match");
        CubatureSolver solver(std::move(elastic), static_cast<int>(L.shape(0)), K.data(), L.data(),
                              S.data());
        require_valid(solver,
                      "the reduced Hessian at rest is not positive definite; the cubature has too "
                      "few tets, or the handles do not hold the shape");
        new (self) CubatureLoop{std::move(solver), std::vector<double>(d, 0.0)};
      },
      nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("K"), nb::arg("L"),
      nb::arg("S"));
  bind_offsets(loop);
  bind_loop(loop);
  bind_blended(m);
}

}  // namespace snapspace
