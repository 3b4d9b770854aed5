#include "bindings/live_loop.h"
#include "online/blended_quartic.h"
#include "online/blending_solver.h"
#include "online/posing_solver.h"
#include "online/reconstruct.h"

namespace snapspace {

namespace {

using online::BlendedQuartic;
using online::Quartic;

online::Storage storage(bool single) {
  return single ? online::Storage::single_precision : online::Storage::double_precision;
}

using PosingSolver = online::PosingSolver<Quartic>;
using PosingLoop = Loop<PosingSolver>;
using BlendingSolver = online::BlendingSolver<BlendedQuartic>;
using BlendingLoop = Loop<BlendingSolver>;

}  // namespace

void bind_online(nb::module_& m) {
  nb::enum_<online::Method>(m, "Method", "How a reduced problem is solved.")
      .value("newton", online::Method::newton)
      .value("bfgs", online::Method::bfgs);
  nb::enum_<online::Status>(m, "Status", "How a reduced solve ended.")
      .value("converged", online::Status::converged)
      .value("max_iterations", online::Status::max_iterations)
      .value("line_search_failed", online::Status::line_search_failed)
      .value("not_finite", online::Status::not_finite)
      .value("max_evaluations", online::Status::max_evaluations);

  nb::class_<online::Report>(m, "Report", "How a reduced solve ended.")
      .def_ro("status", &online::Report::status)
      .def_ro("iterations", &online::Report::iterations)
      .def_ro("evaluations", &online::Report::evaluations)
      .def_ro("value", &online::Report::value)
      .def_ro("gradient_norm", &online::Report::gradient_norm);

  m.def(
      "reconstruct",
      [](VectorIn tau, MatrixIn modes, VectorIn q) {
        require(modes.shape(0) == q.size() && modes.shape(1) == tau.size(),
                "tau (3n,), modes (d, 3n) and q (d,) do not match");
        DoublesOut shape = new_array<double>({tau.size()});
        online::reconstruct(tau.size(), static_cast<int>(q.size()), tau.data(), modes.data(),
                            q.data(), shape.data());
        return shape;
      },
      nb::arg("tau"), nb::arg("modes"), nb::arg("q"), "tau + sum of q_i modes_i, (3n,).");

  nb::class_<Quartic>(m, "Quartic",
                      "Polynomial of degree four with fully symmetric packed coefficients.")
      .def(
          "__init__",
          [](Quartic* self, int dimension, VectorIn coefficients, bool single) {
            require(dimension >= 1 && coefficients.size() == online::quartic_count(dimension + 1),
                    "coefficients must have C(dimension + 4, 4) entries");
            new (self) Quartic(dimension, coefficients.data(), storage(single));
          },
          nb::arg("dimension"), nb::arg("coefficients"), nb::kw_only(), nb::arg("single") = false)
      .def_prop_ro("dimension", &Quartic::dimension)
      .def(
          "value_and_gradient",
          [](Quartic& self, VectorIn q) { return value_and_gradient(self, q); }, nb::arg("q"))
      .def(
          "derivatives", [](Quartic& self, VectorIn q) { return derivatives(self, q); },
          nb::arg("q"), "Value, gradient and Hessian in one pass.");

  nb::class_<PosingLoop> posing(m, "PosingLoop",
                                "The live loop of posing: set offsets, solve from the last frame.");
  posing.def(
      "__init__",
      [](PosingLoop* self, VectorIn coefficients, MatrixIn K, TensorIn L, TensorIn S, bool single) {
        const auto d = K.shape(0);
        require(d >= 1 && K.shape(1) == d && coefficients.size() == online::quartic_count(d + 1) &&
                    L.shape(1) == d && L.shape(2) == 12 && S.shape(0) == L.shape(0) &&
                    S.shape(1) == 4 && S.shape(2) == 4,
                "coefficients (C(d+4,4),), K (d,d), L (h,d,12), S (h,4,4) do not match");
        const auto dimension = static_cast<int>(d);
        PosingSolver solver(Quartic(dimension, coefficients.data(), storage(single)),
                            static_cast<int>(L.shape(0)), K.data(), L.data(), S.data());
        require_valid(solver,
                      "the reduced Hessian at rest is not positive definite; the model is "
                      "damaged or its handles do not hold the shape");
        new (self) PosingLoop{std::move(solver), std::vector<double>(d, 0.0)};
      },
      nb::arg("coefficients"), nb::arg("K"), nb::arg("L"), nb::arg("S"), nb::kw_only(),
      nb::arg("single") = false);
  bind_offsets(posing);
  bind_loop(posing);

  nb::class_<BlendingLoop> blending(
      m, "BlendingLoop", "The live loop of blending: set weights, solve from the last frame.");
  blending.def(
      "__init__",
      [](BlendingLoop* self, int dimension, MatrixIn coefficients, bool single) {
        require(dimension >= 1 && coefficients.shape(0) >= 1 &&
                    coefficients.shape(1) == online::quartic_count(dimension + 1),
                "coefficients must be (poses, C(dimension + 4, 4))");
        BlendingSolver solver(BlendedQuartic(dimension, static_cast<int>(coefficients.shape(0)),
                                             coefficients.data(), storage(single)));
        require_valid(solver,
                      "the reduced Hessian at the mean shape is not positive definite; the "
                      "model is damaged or its mean shape is not a minimum");
        const auto d = static_cast<std::size_t>(dimension);
        new (self) BlendingLoop{std::move(solver), std::vector<double>(d, 0.0)};
      },
      nb::arg("dimension"), nb::arg("coefficients"), nb::kw_only(), nb::arg("single") = false,
      nb::keep_alive<1, 3>());
  bind_weights(blending);
  bind_loop(blending);
}

}  // namespace snapspace
