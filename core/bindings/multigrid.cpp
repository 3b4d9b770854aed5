#include "bindings/lane_solves.h"
#include "bindings/sparse_matrix.h"
#include "multigrid/lowest_eigenvalue.h"
#include "multigrid/two_grid_cycle.h"
#include "snapshots/scalar_inverse.h"

namespace snapspace {

namespace {

template <Packing packing>
DoublesOut apply(const TwoGridCycle& cycle, MatrixIn right_hand_sides) {
  return solved_in_lanes(cycle.size(), packing, right_hand_sides,
                         [&](std::size_t count, const double* from, double* to) {
                           apply_in_lanes(cycle, packing, count, from, to);
                         });
}

}  // namespace

void bind_multigrid(nb::module_& m) {
  nb::enum_<InverseKind>(m, "InverseKind", "How the inverse of a scalar matrix is applied.")
      .value("automatic", InverseKind::automatic)
      .value("factor", InverseKind::factor)
      .value("cycle", InverseKind::cycle);
  nb::class_<TwoGridCycle>(m, "TwoGridCycle",
                           "Two-grid cycle that approximates the inverse of a sparse symmetric "
                           "matrix (n, n), given by its columns with both triangles. It is applied "
                           "to x, y and z at once.")
      .def(
          "__init__",
          [](TwoGridCycle* self, IndexVectorIn starts, IndexVectorIn rows, VectorIn values) {
            new (self) TwoGridCycle(sparse_matrix(starts, rows, values));
          },
          nb::arg("starts"), nb::arg("rows"), nb::arg("values"))
      .def_prop_ro("coarse_size", &TwoGridCycle::coarse_size)
      .def(
          "lowest_eigenvalue",
          [](const TwoGridCycle& self, IndexVectorIn starts, IndexVectorIn rows, VectorIn values) {
            require(starts.size() == self.size() + 1, "the cycle belongs to another matrix");
            return lowest_eigenvalue(sparse_matrix(starts, rows, values), self);
          },
          nb::arg("starts"), nb::arg("rows"), nb::arg("values"),
          "Estimate from above of the lowest eigenvalue of cycle * matrix. The matrix must be the "
          "one that the cycle was made from.")
      .def("apply", &apply<Packing::alone>, nb::arg("right_hand_side"),
           "Cycle times one right-hand side (1, 3n).")
      .def("apply_lanes", &apply<Packing::lanes>, nb::arg("right_hand_sides"),
           "Cycle times up to lane_count right-hand sides (k, 3n), one per lane.")
      .def("apply_single_lanes", &apply<Packing::single_lanes>, nb::arg("right_hand_sides"),
           "`apply_lanes` in single precision, for up to twice as many right-hand sides.");
}

}  // namespace snapspace
