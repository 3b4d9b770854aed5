#include "polish/polish.h"

#include "bindings/arrays.h"
#include "bindings/released_gil.h"

namespace snapspace {

void bind_polish(nb::module_& m) {
  nb::class_<CoarseSpace>(m, "CoarseSpace",
                          "Modes (d, 3n) in the numbering of a system, in single precision.")
      .def(
          "__init__",
          [](CoarseSpace* self, const SampleSystem& system, MatrixIn modes) {
            require(
                modes.shape(0) >= 1 && modes.shape(1) == static_cast<std::size_t>(system.size()),
                "modes must be (d, 3n)");
            new (self) CoarseSpace(system.numbering, modes.data(), static_cast<int>(modes.shape(0)),
                                   modes.shape(1));
          },
          nb::arg("system"), nb::arg("modes"));
  m.def(
      "polish",
      [](const SampleSystem& system, const CoarseSpace* coarse, MatrixIn inverse, VectorIn input,
         VectorIn start, double tolerance, int max_iterations, int threads, SolveControl& control) {
        const auto size = static_cast<std::size_t>(system.size());
        require(input.size() == static_cast<std::size_t>(system.input_size()),
                "the input must be (input_size,)");
        require(start.size() == size && (!coarse || coarse->size() == size),
                "the start must be (3n,)");
        require(threads >= 1, "threads must be positive");
        const auto d = coarse ? static_cast<std::size_t>(coarse->dimension()) : 0;
        require(inverse.shape(0) == d && inverse.shape(1) == d, "the inverse must be (d, d)");
        Sample sample{0,
                      {input.data(), input.data() + input.size()},
                      {start.data(), start.data() + start.size()}};
        sample.input.insert(sample.input.end(), inverse.data(), inverse.data() + d * d);
        const SolveOptions options{
            .tolerance = tolerance, .max_iterations = max_iterations, .threads = threads};
        const ReleasedGil released;
        return polish(system, coarse, sample, options, control);
      },
      nb::arg("system"), nb::arg("coarse").none(), nb::arg("inverse"), nb::arg("input"),
      nb::arg("start"), nb::kw_only(), nb::arg("tolerance"), nb::arg("max_iterations"),
      nb::arg("threads"), nb::arg("control"),
      "Runs L-BFGS on one sample from start (3n,), with a two-level seed. `inverse` (d, d) is the "
      "inverse of the Hessian on the coarse space; without a coarse space, as for surfaces with "
      "patches, it is (0, 0). If the solve is cancelled, the shape with the lowest objective so "
      "far is returned.");
}

}  // namespace snapspace
