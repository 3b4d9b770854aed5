#include "bindings/live_loop.h"
#include "bindings/tet_rows.h"
#include "energy/material_field.h"

namespace snapspace {

namespace {

live::CubatureArrays cubature_arrays(const TetRows& rows, const VectorIn& weights,
                                     const MaterialField& material) {
  require(weights.size() == static_cast<std::size_t>(rows.arrays().tets),
          "rows and weights (tets,) do not match");
  require(material.fits(weights.size()), "the material has moduli for a different number of tets");
  return {rows.arrays(), weights.data(), material.view()};
}

/// @param corners  (poses + 1, tets, 12): the tets in each pose, and at the mean shape
live::PoseArrays pose_arrays(const TensorIn& corners, std::size_t tets) {
  require(corners.shape(0) >= 2 && corners.shape(1) == tets && corners.shape(2) == 12,
          "corners must be (poses + 1, tets, 12)");
  const std::size_t poses = corners.shape(0) - 1;
  return {static_cast<int>(poses), corners.data(), corners.data() + poses * 12 * tets};
}

/// The arguments of BlendedStars and of its loop.
live::StarArrays star_arrays(const SingleTensorIn& rows, const VectorIn& weights,
                             const MaterialField& material, const TensorIn& origins,
                             const TensorIn& forms) {
  const std::size_t stars = weights.size(), poses = forms.shape(0), d = rows.shape(2);
  require(stars >= 1 && poses >= 1 && d >= 1 && rows.shape(0) == poses * stars &&
              rows.shape(1) == 9 && origins.shape(0) == poses && origins.shape(1) == stars &&
              origins.shape(2) == 9 && forms.shape(1) == d + 1 && forms.shape(2) == d + 1,
          "rows (poses * stars, 9, d), weights (stars,), origins (poses, stars, 9) and forms "
          "(poses, d + 1, d + 1) do not match");
  require(material.fits(rows.shape(0)), "the material has moduli for a different number of stars");
  return {static_cast<int>(d), static_cast<int>(poses), static_cast<int>(stars), rows.data(),
          weights.data(),      material.view(),         origins.data(),          forms.data()};
}

constexpr auto kNotDefinite =
    "the reduced Hessian at the mean shape is far from positive definite; the model is damaged";

void bind_blended(nb::module_& m) {
  nb::class_<BlendedFunction, TetFunction>(m, "BlendedFunction", "Blended energy of several poses.")
      .def(
          "set_weights",
          [](BlendedFunction& self, VectorIn weights) {
            require(weights.size() == static_cast<std::size_t>(self.blend->poses()),
                    "weights must have one entry per pose");
            self.blend->set_weights(weights.data());
          },
          nb::arg("weights"));
  nb::class_<BlendedCubature, BlendedFunction>(
      m, "BlendedCubature", "Blended energy of several poses as a weighted sum over a few tets.")
      .def(
          "__init__",
          [](BlendedCubature* self, const TetRows& rows, VectorIn weights,
             const MaterialField& material, TensorIn corners) {
            new (self) BlendedCubature(live::blended_cubature(
                cubature_arrays(rows, weights, material), pose_arrays(corners, weights.size())));
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("corners"));
  nb::class_<BlendedStars, BlendedFunction>(
      m, "BlendedStars",
      "Blended ARAP energy of a surface: a weighted sum over a few stars plus a quadratic form.")
      .def(
          "__init__",
          [](BlendedStars* self, SingleTensorIn rows, VectorIn weights,
             const MaterialField& material, TensorIn origins, TensorIn forms) {
            new (self) BlendedStars(
                live::blended_stars(star_arrays(rows, weights, material, origins, forms)));
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("origins"),
          nb::arg("forms"));

  nb::class_<BlendedCubatureLoop, BlendingLoop>(
      m, "BlendedCubatureLoop", "The live loop of blending with a cubature instead of quartics.")
      .def(
          "__init__",
          [](BlendedCubatureLoop* self, const TetRows& rows, VectorIn weights,
             const MaterialField& material, TensorIn corners) {
            new (self)
                BlendedCubatureLoop(live::blending_solver(cubature_arrays(rows, weights, material),
                                                          pose_arrays(corners, weights.size())),
                                    kNotDefinite);
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("corners"));
  nb::class_<BlendedStarsLoop, BlendingLoop>(
      m, "BlendedStarsLoop", "The live loop of blending with stars instead of quartics.")
      .def(
          "__init__",
          [](BlendedStarsLoop* self, SingleTensorIn rows, VectorIn weights,
             const MaterialField& material, TensorIn origins, TensorIn forms) {
            new (self) BlendedStarsLoop(
                live::blending_solver(star_arrays(rows, weights, material, origins, forms)),
                kNotDefinite);
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"), nb::arg("origins"),
          nb::arg("forms"));
}

}  // namespace

void bind_cubature(nb::module_& m) {
  nb::class_<TetRows>(m, "TetRows",
                      "Displacement gradients of tets as linear functions of all coordinates, or "
                      "of the local coordinates of clusters.")
      .def(nb::init<SingleTensorIn>(), nb::arg("rows"))
      .def(nb::init<IndexMatrixIn, SingleVectorIn, SingleMatrixIn>(), nb::arg("sizes"),
           nb::arg("rows"), nb::arg("modes"));

  nb::class_<TetFunction, ReducedFunction>(m, "TetFunction", "A weighted sum over a few tets.")
      .def(
          "curvatures",
          [](TetFunction& self, VectorIn q) {
            const double* at = checked_coordinates(self.function->dimension(), q);
            auto hessians = new_array<float>({static_cast<std::size_t>(self.sum->tets()), 9, 9});
            const ReleasedGil released;
            self.sum->curvatures(at, hessians.data());
            return hessians;
          },
          nb::arg("q"),
          "Weighted Hessians (r, 9, 9) of the tets' energies with respect to their displacement "
          "gradients, float32.")
      .def(
          "stresses",
          [](TetFunction& self, VectorIn q) {
            const double* at = checked_coordinates(self.function->dimension(), q);
            auto stresses = new_array<float>({static_cast<std::size_t>(self.sum->tets()), 9});
            const ReleasedGil released;
            self.sum->stresses(at, stresses.data());
            return stresses;
          },
          nb::arg("q"), "Weighted stresses (r, 9) of the tets, float32.");

  nb::class_<Cubature, TetFunction>(m, "Cubature",
                                    "Elastic energy as a weighted sum over a few tets.")
      .def(
          "__init__",
          [](Cubature* self, const TetRows& rows, VectorIn weights, const MaterialField& material) {
            live::TetPointer function = live::cubature(cubature_arrays(rows, weights, material));
            live::TetFunction* sum = function.get();
            new (self) Cubature{{{std::move(function)}, sum}};
          },
          nb::arg("rows"), nb::arg("weights"), nb::arg("material"));

  nb::class_<CubatureLoop, PosingLoop>(
      m, "CubatureLoop", "The live loop of posing with a cubature instead of a quartic.")
      .def(
          "__init__",
          [](CubatureLoop* self, const TetRows& rows, VectorIn weights,
             const MaterialField& material, MatrixIn K, TensorIn L, TensorIn S) {
            constexpr auto kMismatch =
                "rows (tets, 9, d), K (d,d), L (h,d,12), S (h,4,4) do not match";
            const live::CubatureArrays elastic = cubature_arrays(rows, weights, material);
            require(K.shape(0) == static_cast<std::size_t>(elastic.rows.dimension), kMismatch);
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
