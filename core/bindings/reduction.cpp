#include "bindings/arrays.h"
#include "reduction/quartic_coefficients.h"

namespace snapspace {

void bind_reduction(nb::module_& m) {
  m.def(
      "quartic_coefficients",
      [](const ElasticEnergy& energy, MatrixIn modes, int threads) {
        require(modes.shape(0) >= 2 &&
                    modes.shape(1) == 3 * static_cast<std::size_t>(energy.rest.vertex_count),
                "modes must be (dimension + 1, 3n)");
        std::vector<double> coefficients;
        {
          nb::gil_scoped_release release;
          coefficients = quartic_coefficients(energy, modes.data(),
                                              static_cast<int>(modes.shape(0)) - 1, threads);
        }
        return copy_to_array(coefficients.data(), {coefficients.size()});
      },
      nb::arg("energy"), nb::arg("modes"), nb::kw_only(), nb::arg("threads"),
      "Packed symmetric coefficients (C(d+4, 4),) of the reduced elastic energy; "
      "modes (d+1, 3n): offset, then basis.");
}

}  // namespace snapspace
