#include <numeric>
#include <utility>
#include <vector>

#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "fitting/pose_fitter.h"

namespace snapspace {

namespace {

void construct(FittingSystem* self, const MatrixIn& vertices, const IndexMatrixIn& tets,
               const IndexMatrixIn& corners, const MatrixIn& weights, const VectorIn& areas) {
  require(vertices.shape(1) == 3, "vertices must be (n, 3)");
  require(tets.shape(1) == 4, "tets must be (m, 4)");
  require(corners.shape(1) == 4 && weights.shape(1) == 4, "corners and weights must be (s, 4)");
  require(corners.shape(0) == weights.shape(0) && corners.shape(0) == areas.size(),
          "one row of weights and one area per surface point is needed");
  require_below(tets, vertices.shape(0), "a tet has a vertex index out of range");
  require_below(corners, vertices.shape(0), "a surface point has a corner out of range");
  const LocalMesh mesh(vertices.data(), static_cast<int>(vertices.shape(0)), tets.data(),
                       static_cast<int>(tets.shape(0)));
  const SurfaceSprings springs(corners.data(), weights.data(), areas.data(),
                               static_cast<int>(areas.size()), mesh.places);
  new (self) FittingSystem(mesh, springs);
}

std::vector<double> internal(const FittingSystem& system, const VectorIn& u) {
  require(u.size() == static_cast<std::size_t>(system.size()), "needs a (3n,) vector");
  std::vector<double> result(u.size());
  system.numbering.to_internal(u.data(), result.data());
  return result;
}

DoublesOut external(const FittingSystem& system, const std::vector<double>& u) {
  DoublesOut result = new_array<double>({u.size()});
  system.numbering.to_external(u.data(), result.data());
  return result;
}

/// The energy of fits, without the limits to its growth in a step.
std::pair<double, DoublesOut> energy(const FittingSystem& self, const VectorIn& u, double stretch) {
  std::vector<double> energies, stresses, gradient(self.size());
  const FitEnergy fit(self.energy, stretch);
  fit.evaluate(internal(self, u).data(), energies, stresses);
  fit.add_gradient(stresses, gradient.data());
  return {std::accumulate(energies.begin(), energies.end(), 0.0), external(self, gradient)};
}

DoublesOut hessian_product(const FittingSystem& self, const VectorIn& u, const VectorIn& v,
                           double stretch) {
  BlockHessian hessian = self.pattern;
  FitEnergy(self.energy, stretch).add_hessian(internal(self, u).data(), hessian);
  std::vector<double> product(self.size());
  hessian.multiply(internal(self, v).data(), product.data());
  return external(self, product);
}

std::pair<DoublesOut, FitReport> fit(const FittingSystem& self, const MatrixIn& targets,
                                     const VectorIn& start, double deviation,
                                     double first_stiffness, double stretch, int max_iterations,
                                     const SolveControl& control) {
  require(
      targets.shape(0) == static_cast<std::size_t>(self.springs.size()) && targets.shape(1) == 3,
      "targets must be (points, 3)");
  FitReport report;
  std::vector<double> shape = internal(self, start);
  {
    const ReleasedGil released;
    PoseFitter fitter(self, {deviation, first_stiffness, stretch, max_iterations});
    report = fitter.fit(targets.data(), shape, control);
    shape = fitter.shape();
  }
  return {external(self, shape), report};
}

}  // namespace

void bind_fitting(nb::module_& m) {
  nb::enum_<FitStatus>(m, "FitStatus", "How the fit of one pose ended.")
      .value("converged", FitStatus::converged)
      .value("max_iterations", FitStatus::max_iterations)
      .value("stiffness_limit", FitStatus::stiffness_limit)
      .value("line_search_failed", FitStatus::line_search_failed)
      .value("cancelled", FitStatus::cancelled);

  nb::class_<FitReport>(m, "FitReport", "How the fit of one pose ended.")
      .def_ro("status", &FitReport::status)
      .def_ro("stages", &FitReport::stages)
      .def_ro("iterations", &FitReport::iterations, "Newton steps of all stages.")
      .def_ro("evaluations", &FitReport::evaluations)
      .def_ro("linear_iterations", &FitReport::linear_iterations)
      .def_ro("stiffness", &FitReport::stiffness, "Stiffness of the last stage.")
      .def_ro("deviation", &FitReport::deviation,
              "Root mean square distance between surface and target, weighted by area.")
      .def_ro("seconds", &FitReport::seconds);

  nb::class_<FittingSystem>(m, "FittingSystem",
                            "Data that the fits of all poses of a mesh and its surface share.")
      .def("__init__", &construct, nb::arg("vertices"), nb::arg("tets").noconvert(),
           nb::arg("corners").noconvert(), nb::arg("weights"), nb::arg("areas"))
      .def("energy", &energy, nb::arg("u"), nb::kw_only(), nb::arg("stretch"),
           "Symmetric Dirichlet energy at displacements u (3n,), and its gradient (3n,). The "
           "energy is infinite if a tet is inverted or reaches the largest stretch.")
      .def("projected_hessian_product", &hessian_product, nb::arg("u"), nb::arg("v"), nb::kw_only(),
           nb::arg("stretch"),
           "Product of v (3n,) and the Hessian of the energy at u, whose tets are projected to "
           "positive semi-definite matrices.")
      .def("fit", &fit, nb::arg("targets"), nb::arg("start"), nb::kw_only(), nb::arg("deviation"),
           nb::arg("first_stiffness"), nb::arg("stretch"), nb::arg("max_iterations"),
           nb::arg("control"),
           "Displacements (3n,) that move the surface points by the target displacements (s, 3), "
           "and a report. The fit starts at displacements (3n,) where the energy is finite.");
}

}  // namespace snapspace
