#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "reduction/mode_gradients.h"
#include "reduction/quartic_coefficients.h"
#include "reduction/training_columns.h"

namespace snapspace {

namespace {

using FloatsOut = nb::ndarray<float, nb::ndim<2>, nb::c_contig, nb::device::cpu>;

void bind_training(nb::module_& m) {
  m.def(
      "mode_gradients",
      [](MatrixIn vertices, MatrixIn modes, IndexMatrixIn tets, bool shell, int threads) {
        require(vertices.shape(1) == 3 && modes.shape(1) == vertices.size(),
                "vertices (n, 3) and modes (d, 3n) do not match");
        require(tets.shape(1) == 4, "tets must be (r, 4)");
        require_below(tets, vertices.shape(0), "a tet has a vertex index out of range");
        auto rows = new_array<float>({tets.shape(0), 9, modes.shape(0)});
        const ReleasedGil released;
        mode_gradients(vertices.data(), static_cast<int>(modes.shape(0)), modes.shape(1),
                       modes.data(), shell, static_cast<int>(tets.shape(0)), tets.data(),
                       rows.data(), threads);
        return rows;
      },
      nb::arg("vertices"), nb::arg("modes"), nb::arg("tets"), nb::kw_only(),
      nb::arg("shell") = false, nb::arg("threads"),
      "Displacement gradients (r, 9, d), float32, of modes (d, 3n) in tets (r, 4), or in the "
      "triangles and hinges of a shell.");
  m.def(
      "training_columns",
      [](SingleTensorIn rows, SingleTensorIn stresses, SingleTensorIn along, FloatsOut columns,
         int threads) {
        const std::size_t candidates = rows.shape(0), states = stresses.shape(0);
        require(stresses.shape(1) == candidates && stresses.shape(2) == rows.shape(1) &&
                    along.shape(0) == states && along.shape(1) == rows.shape(2),
                "rows (c, m, d), stresses (s, c, m) and along (s, d, k) do not match");
        require(columns.shape(0) == candidates && columns.shape(1) >= states * along.shape(2),
                "columns must be (c, s k) or wider");
        const TrainingStates training{static_cast<int>(states), static_cast<int>(along.shape(2)),
                                      static_cast<int>(rows.shape(1)), stresses.data(),
                                      along.data()};
        const ReleasedGil released;
        training_columns(static_cast<int>(rows.shape(2)), static_cast<int>(candidates), rows.data(),
                         training, threads, columns.shape(1), columns.data());
      },
      nb::arg("rows"), nb::arg("stresses"), nb::arg("along"), nb::arg("columns"), nb::kw_only(),
      nb::arg("threads"),
      "Writes the products of all tets' forces and the directions `along` (s, d, k) to the first s "
      "* k entries of each row of columns.");
}

}  // namespace

void bind_reduction(nb::module_& m) {
  bind_training(m);
  m.def(
      "quartic_coefficients",
      [](const ElasticEnergy& energy, MatrixIn modes, int threads) {
        require(modes.shape(0) >= 2 &&
                    modes.shape(1) == 3 * static_cast<std::size_t>(energy.rest.vertex_count),
                "modes must be (dimension + 1, 3n)");
        std::vector<double> coefficients;
        {
          const ReleasedGil released;
          coefficients = quartic_coefficients(energy, modes.data(),
                                              static_cast<int>(modes.shape(0)) - 1, threads);
        }
        return copy_to_array(coefficients.data(), {coefficients.size()});
      },
      nb::arg("energy"), nb::arg("modes"), nb::kw_only(), nb::arg("threads"),
      "Packed symmetric coefficients (C(d+4, 4),) of the reduced elastic energy. Modes (d+1, 3n) "
      "are the offset, then the basis.");
}

}  // namespace snapspace
