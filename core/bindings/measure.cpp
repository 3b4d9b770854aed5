#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "measure/machine_peak.h"
#include "measure/online_times.h"
#include "measure/solver_parts.h"

namespace snapspace {

void bind_measure(nb::module_& m) {
  m.def(
      "peak_flops",
      [](bool single, int repeats) {
        const ReleasedGil released;
        return peak_flops(single, repeats);
      },
      nb::kw_only(), nb::arg("single"), nb::arg("repeats") = 20,
      "Peak floating-point operations per second of one thread in this build.");
  m.def(
      "read_bandwidth",
      [](std::size_t bytes, int repeats) {
        const ReleasedGil released;
        return read_bandwidth(bytes, repeats);
      },
      nb::arg("bytes"), nb::kw_only(), nb::arg("repeats") = 20,
      "Bytes per second that one thread reads from an array of this size.");

  m.def(
      "time_quartic",
      [](int dimension, VectorIn coefficients, VectorIn q, bool single, int repeats) {
        require(dimension >= 1 && q.size() == static_cast<std::size_t>(dimension) &&
                    coefficients.size() == live::coefficient_count(dimension),
                "coefficients (C(d+4,4),) and q (d,) do not match");
        const live::FunctionPointer quartic = live::quartic(dimension, coefficients.data(), single);
        const ReleasedGil released;
        const EvaluationTimes times = time_evaluations(*quartic, q.data(), repeats);
        return std::make_pair(times.value_and_gradient, times.derivatives);
      },
      nb::arg("dimension"), nb::arg("coefficients"), nb::arg("q"), nb::kw_only(),
      nb::arg("single") = false, nb::arg("repeats") = 1000,
      "Seconds per evaluation of value and gradient, and of value, gradient and Hessian, on one "
      "thread.");
  m.def(
      "time_reconstruct",
      [](VectorIn tau, MatrixIn modes, VectorIn q, int repeats) {
        require(modes.shape(0) == q.size() && modes.shape(1) == tau.size(),
                "tau (3n,), modes (d, 3n) and q (d,) do not match");
        const ReleasedGil released;
        return time_reconstruct(tau.size(), static_cast<int>(q.size()), tau.data(), modes.data(),
                                q.data(), repeats);
      },
      nb::arg("tau"), nb::arg("modes"), nb::arg("q"), nb::kw_only(), nb::arg("repeats") = 30,
      "Seconds to compute tau + sum of q_i modes_i on one thread.");

  nb::class_<PartTimes>(m, "PartTimes",
                        "Seconds and floating-point operations of the parts of an L-BFGS step.")
      .def_ro("kernel_seconds", &PartTimes::kernel_seconds)
      .def_ro("solve_seconds", &PartTimes::solve_seconds)
      .def_ro("kernel_flops", &PartTimes::kernel_flops)
      .def_ro("solve_flops", &PartTimes::solve_flops);
  m.def(
      "time_parts",
      [](const PosingSystem& system, VectorIn u, bool single, int repeats) {
        require(u.size() == static_cast<std::size_t>(system.size()), "u must be (3n,)");
        std::vector<double> shape(u.size());
        system.numbering.to_internal(u.data(), shape.data());
        const ReleasedGil released;
        return time_parts(system, shape, single, repeats);
      },
      nb::arg("system"), nb::arg("u"), nb::kw_only(), nb::arg("single"), nb::arg("repeats") = 20,
      "Times of one thread with the widest pack, all lanes at displacement u (3n,).");
}

}  // namespace snapspace
