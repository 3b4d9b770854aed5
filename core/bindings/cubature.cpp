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
  require(material.fits(weights.size()), "the material has moduli for a different number of tets");
  return {static_cast<int>(rows.shape(2)), static_cast<int>(rows.shape(0)), rows.data(),
          weights.data(), material.view()};
}

/// @param corners  (poses + 1, tets, 12): the tets in each pose, and at the mean shape
live::PoseArrays pose_arrays(const TensorIn& corners, std::size_t tets) {
  require(corners.shape(0) >= 2 && corners.shape(1) == tets && corners.shape(2) == 12,
          "corners must be (poses + 1, tets, 12)");
  const std::size_t poses = corners.shape(0) - 1;
  return {static_cast<int>(poses), corners.data(), corners.data() + poses * 12 * tets};
}

void bind_blended(nb::module_& m) {
  nb::class_<BlendedCubature, TetFunction>(
      m, "BlendedCubature", "Blended energy of several poses as a weighted sum over few tets.")
      .def(
          "__init__",
          [](BlendedCubature* self, RowsIn rows, VectorIn weights, const MaterialField& material,
             TensorIn corners) {
            live::BlendedPointer function = live::blended_cubature(
                cubature_arrays(rows, weights, material), pose_arrays(corners, weights.size()));
            live::BlendedFunction* blend = function.get();
            new (self) BlendedCubature{{{std::move(function)}, blend}, blend};
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("corners"))
      .def(
          "set_weights",
          [](BlendedCubature& self, VectorIn weights) {
            require(weights.size() == static_cast<std::size_t>(self.blend->poses()),
                    "weights must have one entry per pose");
            self.blend->set_weights(weights.data());
          },
          nb::arg("weights"));

  nb::class_<BlendedCubatureLoop, BlendingLoop>(
      m, "BlendedCubatureLoop", "The live loop of blending with a cubature instead of quartics.")
      .def(
          "__init__",
          [](BlendedCubatureLoop* self, RowsIn rows, VectorIn weights,
             const MaterialField& material, TensorIn corners) {
            new (self) BlendedCubatureLoop(
                live::blending_solver(cubature_arrays(rows, weights, material),
                                      pose_arrays(corners, weights.size())),
                "the reduced Hessian at the mean shape is far from positive definite; the model is "
                "damaged");
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("corners"));
}

}  // namespace

void bind_cubature(nb::module_& m) {
  nb::class_<TetFunction, ReducedFunction>(m, "TetFunction", "A weighted sum over few tets.")
      .def(
          "curvatures",
          [](TetFunction& self, VectorIn q) {
            const double* at = checked_coordinates(self.function->dimension(), q);
            auto hessians = new_array<float>({static_cast<std::size_t>(self.sum->tets()), 9, 9});
            const nb::gil_scoped_release release;
            self.sum->curvatures(at, hessians.data());
            return hessians;
          },
          nb::arg("q"),
          "Weighted Hessians (r, 9, 9) of the tets by their displacement gradients, float32.");

  nb::class_<Cubature, TetFunction>(m, "Cubature",
                                    "Elastic energy as a weighted sum over few tets.")
      .def(
          "__init__",
          [](Cubature* self, RowsIn rows, VectorIn weights, const MaterialField& material) {
            live::TetPointer function = live::cubature(cubature_arrays(rows, weights, material));
            live::TetFunction* sum = function.get();
            new (self) Cubature{{{std::move(function)}, sum}};
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
  bind_blended(m);
}

}  // namespace snapspace
