#include "snapshots/linear_response.h"

#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "snapshots/warp.h"

namespace snapspace {

void bind_linear_response(nb::module_& m) {
  nb::class_<LinearResponse>(m, "LinearResponse",
                             "Linear responses of a posing system at rest: its displacements for "
                             "small displacements (count, input_size) of the handles.")
      .def(
          "__init__",
          [](LinearResponse* self, const PosingSystem& system, MatrixIn inputs) {
            require(inputs.shape(1) == static_cast<std::size_t>(system.input_size()),
                    "inputs must be (count, input_size)");
            require(inputs.shape(0) > 0, "at least one input is needed");
            const ReleasedGil released;
            new (self) LinearResponse(system, inputs.data(), static_cast<int>(inputs.shape(0)));
          },
          nb::arg("system"), nb::arg("inputs"))
      .def(
          "warped",
          [](const LinearResponse& self, const PosingSystem& system, MatrixIn coordinates,
             MatrixIn inputs) {
            require(self.size() == static_cast<std::size_t>(system.size()),
                    "the responses belong to another system");
            require(coordinates.shape(1) == static_cast<std::size_t>(self.count()),
                    "coordinates must be (samples, count)");
            require(inputs.shape(0) == coordinates.shape(0) &&
                        inputs.shape(1) == static_cast<std::size_t>(system.input_size()),
                    "inputs must be (samples, input_size)");
            DoublesOut displacements = new_array<double>({inputs.shape(0), self.size()});
            const ReleasedGil released;
            warp(system, self, coordinates.data(), inputs.data(), static_cast<int>(inputs.shape(0)),
                 displacements.data());
            return displacements;
          },
          nb::arg("system"), nb::arg("coordinates"), nb::arg("inputs"),
          "Displacements (samples, 3n) near the solutions for inputs (samples, input_size). Their "
          "linear parts are combinations of the responses with coefficients `coordinates` "
          "(samples, count).");
}

}  // namespace snapspace
