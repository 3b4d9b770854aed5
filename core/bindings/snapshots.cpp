#include "bindings/arrays.h"
#include "snapshots/solve.h"

namespace snapspace {

namespace {

struct Batch {
  DoublesOut shapes;
  std::vector<SolveReport> reports;
  long linear_iterations = 0;
};

PosingSamples posing_samples(const PosingSystem& system, const TensorIn& targets,
                             const MatrixIn& starts, double* shapes) {
  require(targets.shape(1) == system.pinned.size() && targets.shape(2) == 3,
          "targets must be (samples, pinned, 3)");
  require(starts.shape(0) == targets.shape(0) &&
              starts.shape(1) == static_cast<std::size_t>(system.size()),
          "starts must be (samples, 3n)");
  return {static_cast<int>(targets.shape(0)), targets.data(), starts.data(), shapes};
}

}  // namespace

void bind_snapshots(nb::module_& m) {
  nb::enum_<SolveStatus>(m, "SolveStatus", "How a full-space solve ended.")
      .value("converged", SolveStatus::converged)
      .value("max_iterations", SolveStatus::max_iterations)
      .value("line_search_failed", SolveStatus::line_search_failed)
      .value("not_finite", SolveStatus::not_finite)
      .value("cancelled", SolveStatus::cancelled);

  nb::class_<SolveReport>(m, "SolveReport", "How the solve of one sample ended.")
      .def_ro("status", &SolveReport::status)
      .def_ro("iterations", &SolveReport::iterations)
      .def_ro("evaluations", &SolveReport::evaluations)
      .def_ro("value", &SolveReport::value, "Objective at the returned shape.")
      .def_ro("gradient_norm", &SolveReport::gradient_norm, "Euclidean norm of its gradient.")
      .def_ro("decrement", &SolveReport::decrement,
              "-g.d of the last direction d: twice the decrease that the quadratic model predicts.")
      .def_ro("seconds", &SolveReport::seconds, "Wall time from start to end of this sample.")
      .def_ro("inverted_tets", &SolveReport::inverted_tets);

  nb::class_<SolveControl>(m, "SolveControl",
                           "Shared with a running solve: ends it early, counts what is finished.")
      .def(nb::init<>())
      .def("cancel", [](SolveControl& self) { self.cancelled = true; })
      .def_prop_ro("finished", [](const SolveControl& self) { return self.finished.load(); });

  nb::class_<Batch>(m, "Batch", "Solutions of one call.")
      .def_prop_ro(
          "shapes", [](const Batch& self) { return self.shapes; }, nb::rv_policy::automatic,
          "(samples, 3n) displacements from rest.")
      .def_ro("reports", &Batch::reports)
      .def_ro("linear_iterations", &Batch::linear_iterations,
              "Conjugate gradient iterations of all samples together (Newton only).");

  nb::class_<PosingSystem>(m, "PosingSystem",
                           "What all samples of a posing problem share, with its scalar factor.")
      .def(
          "__init__",
          [](PosingSystem* self, MatrixIn vertices, IndexMatrixIn tets, double lam, double mu,
             IndexVectorIn pinned, VectorIn weights) {
            require(vertices.shape(1) == 3, "vertices must be (n, 3)");
            require(tets.shape(1) == 4, "tets must be (m, 4)");
            require(pinned.size() == weights.size(), "one weight per pinned vertex is needed");
            const auto n = static_cast<std::int32_t>(vertices.shape(0));
            for (std::size_t i = 0; i < pinned.size(); ++i)
              require(pinned.data()[i] >= 0 && pinned.data()[i] < n,
                      "a pinned vertex is out of range");
            for (std::size_t i = 0; i < tets.size(); ++i)
              require(tets.data()[i] >= 0 && tets.data()[i] < n,
                      "a tet has a vertex index out of range");
            const LocalMesh mesh(vertices.data(), n, tets.data(), static_cast<int>(tets.shape(0)));
            new (self)
                PosingSystem(mesh, StVK{lam, mu}, {pinned.data(), pinned.data() + pinned.size()},
                             {weights.data(), weights.data() + weights.size()});
          },
          nb::arg("vertices"), nb::arg("tets").noconvert(), nb::arg("lam"), nb::arg("mu"),
          nb::arg("pinned").noconvert(), nb::arg("weights"))
      .def_prop_ro("factor_nonzeros",
                   [](const PosingSystem& self) { return self.factor.nonzeros(); })
      .def(
          "precondition",
          [](const PosingSystem& self, VectorIn vector) {
            require(vector.size() == static_cast<std::size_t>(self.size()), "needs a (3n,) vector");
            DoublesOut result = new_array<double>({vector.size()});
            std::vector<double> shape(vector.size()), scratch(vector.size());
            self.to_internal(vector.data(), shape.data());
            self.factor.solve(shape.data(), shape.data(), scratch.data());
            self.to_external(shape.data(), result.data());
            return result;
          },
          nb::arg("vector"), "Inverse of the scalar matrix, applied to x, y and z.")
      .def(
          "solve_fast",
          [](const PosingSystem& self, TensorIn targets, MatrixIn starts, double tolerance,
             int max_iterations, int threads, SolveControl& control, bool wide) {
            Batch batch{new_array<double>({starts.shape(0), starts.shape(1)}), {}};
            const PosingSamples samples =
                posing_samples(self, targets, starts, batch.shapes.data());
            nb::gil_scoped_release release;
            batch.reports =
                solve_fast(self, samples, {tolerance, max_iterations, wide, threads}, control);
            return batch;
          },
          nb::arg("targets"), nb::arg("starts"), nb::kw_only(), nb::arg("tolerance"),
          nb::arg("max_iterations"), nb::arg("threads"), nb::arg("control"), nb::arg("wide") = true)
      .def(
          "solve_newton",
          [](const PosingSystem& self, TensorIn targets, MatrixIn starts, double tolerance,
             int max_iterations, int threads, double clamp, SolveControl& control) {
            Batch batch{new_array<double>({starts.shape(0), starts.shape(1)}), {}};
            const PosingSamples samples =
                posing_samples(self, targets, starts, batch.shapes.data());
            nb::gil_scoped_release release;
            batch.reports = solve_newton(self, samples, {tolerance, max_iterations, true, threads},
                                         clamp, control, &batch.linear_iterations);
            return batch;
          },
          nb::arg("targets"), nb::arg("starts"), nb::kw_only(), nb::arg("tolerance"),
          nb::arg("max_iterations"), nb::arg("threads"), nb::arg("clamp"), nb::arg("control"));
}

}  // namespace snapspace
