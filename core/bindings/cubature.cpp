#include "bindings/live_loop.h"
#include "energy/material_field.h"

namespace snapspace {

namespace {

using RowsIn = nb::ndarray<const float, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

live::CubatureArrays cubature_arrays(const RowsIn& rows, const VectorIn& weights,
                                     const MaterialField& material) {
  require(rows.shape(0) >= 1 && rows.shape(1) == 9 && rows.shape(2) >= 1 &&
              weights.size() == rows.shape(0),
          "rows (tets, 9, d) and weights (tets,) do not match");
  require(material.fits(weights.size()), "the material has moduli for another number of tets");
  return {static_cast<int>(rows.shape(2)), static_cast<int>(rows.shape(0)), rows.data(),
          weights.data(), material.view()};
}

}  // namespace

void bind_cubature(nb::module_& m) {
  nb::class_<Cubature, ReducedFunction>(m, "Cubature",
                                        "Elastic energy as a weighted sum over few tets.")
      .def(
          "__init__",
          [](Cubature* self, RowsIn rows, VectorIn weights, const MaterialField& material) {
            new (self) Cubature{{live::cubature(cubature_arrays(rows, weights, material))}};
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"));

  nb::class_<CubatureLoop, PosingLoop>(
      m, "CubatureLoop", "The live loop of posing with a cubature instead of a quartic.")
      .def(
          "__init__",
          [](CubatureLoop* self, RowsIn rows, VectorIn weights, const MaterialField& material,
             MatrixIn K, TensorIn L, TensorIn S) {
            constexpr auto kMismatch =
                "rows (tets, 9, d), K (d,d), L (h,d,12), S (h,4,4) do not match";
            const live::CubatureArrays elastic = cubature_arrays(rows, weights, material);
            require(K.shape(0) == rows.shape(2), kMismatch);
            new (self) CubatureLoop(
                live::posing_solver(elastic, handle_arrays(K, L, S, kMismatch)),
                "the reduced Hessian at rest is not positive definite; the cubature has too few "
                "tets, or the handles do not hold the shape");
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("K"), nb::arg("L"),
          nb::arg("S"));
}

}  // namespace snapspace
