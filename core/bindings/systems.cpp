#include <algorithm>
#include <utility>
#include <vector>

#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "snapshots/interpolation_system.h"
#include "snapshots/posing_system.h"

namespace snapspace {

namespace {

void check_blend(const InterpolationSystem& system, const VectorIn& u, const VectorIn& weights) {
  require(u.size() == static_cast<std::size_t>(system.size()) &&
              weights.size() == static_cast<std::size_t>(system.input_size()),
          "needs a (3n,) vector and (input_size,) weights");
}

/// Matrices (m, size, size) of all tets at u, which fill(tet, u, matrix) makes in the system's
/// numbering.
template <int size, class Fill>
DoublesOut of_tets(const InterpolationSystem& system, const VectorIn& u, Fill fill) {
  const auto tets = static_cast<std::size_t>(system.energy->tets());
  DoublesOut result = new_array<double>({tets, size, size});
  std::vector<double> shape(u.size());
  system.numbering.to_internal(u.data(), shape.data());
  for (std::size_t t = 0; t < tets; ++t) {
    double matrix[size][size];
    fill(static_cast<int>(t), shape.data(), matrix);
    std::copy_n(&matrix[0][0], size * size,
                result.data() + size * size * static_cast<std::size_t>(system.tet_order[t]));
  }
  return result;
}

LocalMesh local_mesh(const double* vertices, std::size_t count, const IndexMatrixIn& tets) {
  require(tets.shape(1) == 4, "tets must be (m, 4)");
  const auto n = static_cast<std::int32_t>(count);
  require_below(tets, count, "a tet has a vertex index out of range");
  return {vertices, n, tets.data(), static_cast<int>(tets.shape(0))};
}

}  // namespace

void bind_systems(nb::module_& m) {
  nb::class_<PosingSystem, System> posing(
      m, "PosingSystem",
      "Data that all samples of a posing problem share, with the scalar factor. Inputs are the "
      "target displacements of the pinned vertices.");
  posing.def(
      "__init__",
      [](PosingSystem* self, MatrixIn vertices, IndexMatrixIn tets, const MaterialField& material,
         IndexVectorIn pinned, VectorIn weights, InverseKind inverse) {
        require(vertices.shape(1) == 3, "vertices must be (n, 3)");
        require(pinned.size() == weights.size(), "one weight per pinned vertex is needed");
        const auto n = static_cast<std::int32_t>(vertices.shape(0));
        for (std::size_t i = 0; i < pinned.size(); ++i)
          require(pinned.data()[i] >= 0 && pinned.data()[i] < n, "a pinned vertex is out of range");
        const ReleasedGil released;
        const LocalMesh mesh = local_mesh(vertices.data(), vertices.shape(0), tets);
        new (self) PosingSystem(mesh, material, {pinned.data(), pinned.data() + pinned.size()},
                                {weights.data(), weights.data() + weights.size()}, inverse);
      },
      nb::arg("vertices"), nb::arg("tets").noconvert(), nb::arg("material"),
      nb::arg("pinned").noconvert(), nb::arg("weights"), nb::kw_only(),
      nb::arg("inverse") = InverseKind::automatic);

  nb::class_<InterpolationSystem, System> interpolation(
      m, "InterpolationSystem",
      "Data that all samples of an interpolation problem share, with the scalar factor. Inputs are "
      "the weights of the poses, and displacements are from pose 0.");
  interpolation.def(
      "__init__",
      [](InterpolationSystem* self, TensorIn poses, IndexMatrixIn tets,
         const MaterialField& material) {
        require(poses.shape(0) >= 1 && poses.shape(2) == 3, "poses must be (k, n, 3)");
        const ReleasedGil released;
        const LocalMesh mesh = local_mesh(poses.data(), poses.shape(1), tets);
        const Numbering numbering(mesh.order);
        const std::size_t size = 3 * poses.shape(1);
        std::vector<double> renumbered(poses.size());
        for (std::size_t k = 0; k < poses.shape(0); ++k)
          numbering.to_internal(poses.data() + k * size, renumbered.data() + k * size);
        new (self)
            InterpolationSystem(mesh, renumbered, static_cast<int>(poses.shape(0)), material);
      },
      nb::arg("poses"), nb::arg("tets").noconvert(), nb::arg("material"));
  interpolation.def(
      "adapted",
      [](const InterpolationSystem& self, MatrixIn shapes, MatrixIn weights) {
        require(shapes.shape(0) >= 1 && shapes.shape(1) == static_cast<std::size_t>(self.size()),
                "shapes must be (k, 3n)");
        require(weights.shape(0) == shapes.shape(0) &&
                    weights.shape(1) == static_cast<std::size_t>(self.input_size()),
                "weights must be (k, poses)");
        std::vector<double> renumbered(shapes.size());
        for (std::size_t k = 0; k < shapes.shape(0); ++k)
          self.numbering.to_internal(shapes.data() + k * shapes.shape(1),
                                     renumbered.data() + k * shapes.shape(1));
        const ReleasedGil released;
        return self.adapted(renumbered, {weights.data(), weights.data() + weights.size()});
      },
      nb::arg("shapes"), nb::arg("weights"),
      "The same system with an inverse that is adapted to solutions: those near displacements (k, "
      "3n) for weights (k, poses).");
  interpolation.def(
      "some_tet_stresses",
      [](const InterpolationSystem& self, VectorIn u, VectorIn weights, IndexVectorIn which) {
        check_blend(self, u, weights);
        std::vector<std::int32_t> places(self.tet_order.size(), -1);  // in the result
        for (std::size_t i = 0; i < which.size(); ++i) {
          require(which(i) >= 0 && which(i) < self.energy->tets(), "a tet is not in the mesh");
          require(places[which(i)] < 0, "a tet occurs twice");
          places[which(i)] = static_cast<std::int32_t>(i);
        }
        DoublesOut stresses = new_array<double>({which.size(), 9}),
                   energies = new_array<double>({which.size()});
        {
          const ReleasedGil released;
          std::vector<std::int32_t> some;  // in the order of the system
          for (std::size_t t = 0; t < places.size(); ++t)
            if (places[self.tet_order[t]] >= 0) some.push_back(static_cast<std::int32_t>(t));
          std::vector<double> shape(u.size()), P(9 * some.size()), psi(some.size());
          self.numbering.to_internal(u.data(), shape.data());
          self.energy->tet_stresses(some, weights.data(), shape.data(), P.data(), psi.data());
          for (std::size_t i = 0; i < some.size(); ++i) {
            const std::int32_t place = places[self.tet_order[some[i]]];
            std::copy_n(P.data() + 9 * i, 9, stresses.data() + 9 * place);
            energies.data()[place] = psi[i];
          }
        }
        return std::make_pair(stresses, energies);
      },
      nb::arg("u"), nb::arg("weights"), nb::arg("which"),
      "First Piola-Kirchhoff stress relative to pose 0, times the volume there, (c, 9), and energy "
      "(c,) of some tets (c,), each of which occurs once.");
  interpolation.def(
      "tet_hessians",
      [](const InterpolationSystem& self, VectorIn u, VectorIn weights) {
        check_blend(self, u, weights);
        require(self.energy->has_tet_hessians(), "the density has no Hessians of blends");
        return of_tets<9>(self, u, [&](int t, const double* shape, double (&H)[9][9]) {
          self.energy->tet_hessian(t, weights.data(), shape, H);
        });
      },
      nb::arg("u"), nb::arg("weights"),
      "Hessian (m, 9, 9) of each tet's energy with respect to its displacement gradient relative "
      "to pose 0.");
  interpolation.def(
      "scalar_hessians",
      [](const InterpolationSystem& self, VectorIn u, VectorIn weights) {
        check_blend(self, u, weights);
        require(self.energy->has_scalar_hessians(), "the density has no scalar Hessians of blends");
        return of_tets<3>(self, u, [&](int t, const double* shape, double (&D)[3][3]) {
          self.energy->scalar_hessian(t, weights.data(), shape, D);
        });
      },
      nb::arg("u"), nb::arg("weights"),
      "The matrix (m, 3, 3) that replaces it for each row of the displacement gradient in the "
      "scalar factor.");
}

}  // namespace snapspace
