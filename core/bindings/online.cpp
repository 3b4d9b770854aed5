#include "bindings/live_loop.h"
#include "live/reconstruct.h"
#include "live/shape_rows.h"

namespace snapspace {

namespace {

void bind_reports(nb::module_& m) {
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
}

void bind_functions(nb::module_& m) {
  nb::class_<ReducedFunction>(m, "ReducedFunction", "A function of reduced coordinates q (d,).")
      .def_prop_ro("dimension",
                   [](const ReducedFunction& self) { return self.function->dimension(); })
      .def(
          "value_and_gradient",
          [](ReducedFunction& self, VectorIn q) { return value_and_gradient(*self.function, q); },
          nb::arg("q"))
      .def(
          "derivatives",
          [](ReducedFunction& self, VectorIn q) { return derivatives(*self.function, q); },
          nb::arg("q"), "Value, gradient and Hessian in one pass.");
  nb::class_<Quartic, ReducedFunction>(
      m, "Quartic", "Polynomial of degree four with fully symmetric packed coefficients.")
      .def(
          "__init__",
          [](Quartic* self, int dimension, VectorIn coefficients, bool single) {
            require(dimension >= 1 && coefficients.size() == live::coefficient_count(dimension),
                    "coefficients must have C(dimension + 4, 4) entries");
            new (self) Quartic{{live::quartic(dimension, coefficients.data(), single)}};
          },
          nb::arg("dimension"), nb::arg("coefficients"), nb::kw_only(), nb::arg("single") = false);
}

/// Binds what the loops of all problems share.
void bind_loop(nb::module_& m) {
  nb::class_<LiveLoop>(m, "LiveLoop",
                       "Solves frame by frame; every solve starts from the last "
                       "frame.")
      .def_prop_rw(
          "q",
          [](const LiveLoop& self) {
            return copy_to_array(self.q.data(),
                                 {static_cast<std::size_t>(self.solver->dimension())});
          },
          [](LiveLoop& self, VectorIn q) {
            std::copy_n(checked_coordinates(self.solver->dimension(), q), q.size(), self.q.data());
          },
          nb::for_getter(nb::rv_policy::automatic))
      .def_prop_rw(
          "dimension", [](const LiveLoop& self) { return self.solver->dimension(); },
          [](LiveLoop& self, int dimension) {
            require(1 <= dimension && dimension <= self.solver->capacity(),
                    "dimension must be between 1 and that of the model");
            const auto kept = std::min(dimension, self.solver->dimension());
            std::fill(self.q.begin() + kept, self.q.end(), 0.0);
            self.solver->set_dimension(dimension);
          })
      .def(
          "value_and_gradient",
          [](LiveLoop& self, VectorIn q) { return value_and_gradient(*self.solver, q); },
          nb::arg("q"))
      .def(
          "hessian",
          [](LiveLoop& self, VectorIn q) { return std::get<2>(derivatives(*self.solver, q)); },
          nb::arg("q"))
      .def(
          "solve",
          [](LiveLoop& self, online::Method method, double tolerance, int max_iterations,
             int max_evaluations, double value_scale, double coordinate_scale) {
            return self.solver->solve(
                self.q.data(), method,
                {tolerance, value_scale, coordinate_scale, max_iterations, max_evaluations});
          },
          nb::kw_only(), nb::arg("method"), nb::arg("tolerance"), nb::arg("max_iterations"),
          nb::arg("max_evaluations"), nb::arg("value_scale"), nb::arg("coordinate_scale"))
      .def(
          "step",
          [](LiveLoop& self, VectorIn target, double weight, online::Method method,
             double tolerance, int max_iterations, int max_evaluations, double value_scale,
             double coordinate_scale) {
            const double* aim = checked_coordinates(self.solver->dimension(), target);
            const online::StepReport step = self.solver->step(
                self.q.data(), weight, aim, method,
                {tolerance, value_scale, coordinate_scale, max_iterations, max_evaluations});
            return std::make_pair(step.report, step.before);
          },
          nb::arg("target"), nb::kw_only(), nb::arg("weight"), nb::arg("method"),
          nb::arg("tolerance"), nb::arg("max_iterations"), nb::arg("max_evaluations"),
          nb::arg("value_scale"), nb::arg("coordinate_scale"),
          "Report, and the objective before the step.")
      .def(
          "softest", [](LiveLoop& self) { return self.solver->softest(); },
          "The smallest curvature at q = 0, for handles at rest or equal weights.");
}

void bind_posing(nb::module_& m) {
  nb::class_<PosingLoop, LiveLoop>(
      m, "PosingLoop", "The live loop of posing: set offsets, then solve from the last frame.")
      .def(
          "__init__",
          [](PosingLoop* self, VectorIn coefficients, MatrixIn K, TensorIn L, TensorIn S,
             bool single) {
            constexpr auto kMismatch =
                "coefficients (C(d+4,4),), K (d,d), L (h,d,12), S (h,4,4) do not match";
            const auto dimension = static_cast<int>(K.shape(0));
            require(dimension >= 1 && coefficients.size() == live::coefficient_count(dimension),
                    kMismatch);
            const live::HandleArrays handles = handle_arrays(K, L, S, kMismatch);
            new (self) PosingLoop(
                live::posing_solver(dimension, coefficients.data(), single, handles),
                "the reduced Hessian at rest is not positive definite; the model is damaged or "
                "its handles do not hold the shape");
          },
          nb::arg("coefficients"), nb::arg("K"), nb::arg("L"), nb::arg("S"), nb::kw_only(),
          nb::arg("single") = false)
      .def(
          "set_offsets",
          [](PosingLoop& self, TensorIn offsets) {
            require(offsets.shape(0) == static_cast<std::size_t>(self.solver->inputs()) &&
                        offsets.shape(1) == 3 && offsets.shape(2) == 4,
                    "offsets must be (handles, 3, 4)");
            self.solver->set_inputs(offsets.data());
          },
          nb::arg("offsets"));
}

void bind_blending(nb::module_& m) {
  nb::class_<BlendingLoop, LiveLoop>(
      m, "BlendingLoop", "The live loop of blending: set weights, then solve from the last frame.")
      .def(
          "__init__",
          [](BlendingLoop* self, int dimension, MatrixIn coefficients, bool single) {
            require(dimension >= 1 && coefficients.shape(0) >= 1 &&
                        coefficients.shape(1) == live::coefficient_count(dimension),
                    "coefficients must be (poses, C(dimension + 4, 4))");
            new (self) BlendingLoop(
                live::blending_solver(dimension, static_cast<int>(coefficients.shape(0)),
                                      coefficients.data(), single),
                "the reduced Hessian at the mean shape is far from positive definite; the model is "
                "damaged");
          },
          nb::arg("dimension"), nb::arg("coefficients"), nb::kw_only(), nb::arg("single") = false,
          nb::keep_alive<1, 3>())
      .def(
          "set_weights",
          [](BlendingLoop& self, VectorIn weights) {
            require(weights.size() == static_cast<std::size_t>(self.solver->inputs()),
                    "weights must have one entry per pose");
            self.solver->set_inputs(weights.data());
          },
          nb::arg("weights"));
}

void bind_shape_rows(nb::module_& m) {
  nb::class_<live::ShapeRows>(m, "ShapeRows",
                              "Shapes tau + U q of one basis for display, with modes in 16 bits.")
      .def(
          "__init__",
          [](live::ShapeRows* self, VectorIn tau, MatrixIn modes) {
            require(modes.shape(1) == tau.size(), "tau (3n,) and modes (d, 3n) do not match");
            new (self) live::ShapeRows(tau.size(), static_cast<int>(modes.shape(0)), tau.data(),
                                       modes.data());
          },
          nb::arg("tau"), nb::arg("modes"))
      .def_prop_ro("bytes", &live::ShapeRows::bytes,
                   "Bytes that are read to compute a shape from all modes.")
      .def(
          "shape",
          [](const live::ShapeRows& self, VectorIn q, int threads) {
            require(q.size() <= static_cast<std::size_t>(self.dimension()),
                    "q must have an entry for each mode, or for the first ones");
            auto shape = new_array<float>({self.size()});
            {
              const ReleasedGil released;
              self.shape(q.data(), static_cast<int>(q.size()), threads, shape.data());
            }
            return shape;
          },
          nb::arg("q"), nb::kw_only(), nb::arg("threads") = 0,
          "tau + U q (3n,) in single precision, where q has the first coordinates, on this many "
          "threads (0: as many as are worthwhile).");
}

}  // namespace

void bind_online(nb::module_& m) {
  bind_reports(m);
  m.def(
      "reconstruct",
      [](VectorIn tau, MatrixIn modes, VectorIn q) {
        require(modes.shape(0) == q.size() && modes.shape(1) == tau.size(),
                "tau (3n,), modes (d, 3n) and q (d,) do not match");
        DoublesOut shape = new_array<double>({tau.size()});
        live::reconstruct(tau.size(), static_cast<int>(q.size()), tau.data(), modes.data(),
                          q.data(), shape.data());
        return shape;
      },
      nb::arg("tau"), nb::arg("modes"), nb::arg("q"), "tau + sum of q_i modes_i, (3n,).");
  bind_shape_rows(m);
  bind_functions(m);
  bind_loop(m);
  bind_posing(m);
  bind_blending(m);
}

}  // namespace snapspace
