#include <algorithm>

#include "bindings/lane_solves.h"
#include "bindings/sparse_matrix.h"
#include "cholesky/orderings.h"
#include "cholesky/scalar_factor.h"

namespace snapspace {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

template <std::vector<std::int32_t> (*Order)(const Matrix&)>
IndicesOut order(IndexVectorIn starts, IndexVectorIn rows) {
  const std::vector<double> ones(rows.size(), 1.0);
  const std::vector<std::int32_t> result = Order(sparse_matrix(starts, rows, ones.data()));
  return copy_to_array(result.data(), {result.size()});
}

ScalarFactor in_order(IndexVectorIn starts, IndexVectorIn rows, VectorIn values,
                      IndexVectorIn elimination) {
  const Matrix A = sparse_matrix(starts, rows, values);
  const std::vector<std::int32_t> given(elimination.data(),
                                        elimination.data() + elimination.size());
  std::vector<std::int32_t> sorted = given;
  std::sort(sorted.begin(), sorted.end());
  bool all = sorted.size() == starts.size() - 1;
  for (std::size_t i = 0; i < sorted.size(); ++i) all = all && sorted[i] == static_cast<int>(i);
  require(all, "the order must contain every vertex once");
  return {A, Supernodes(A, given)};
}

template <Packing packing>
DoublesOut solve(const ScalarFactor& factor, MatrixIn right_hand_sides) {
  return solved_in_lanes(factor.size(), packing, right_hand_sides,
                         [&](std::size_t count, const double* from, double* to) {
                           solve_in_lanes(factor, packing, count, from, to);
                         });
}

}  // namespace

void bind_cholesky(nb::module_& m) {
  m.def("minimum_degree", &order<minimum_degree>, nb::arg("starts"), nb::arg("rows"),
        "Elimination order (n,) by minimum degree for a symmetric pattern, given by its columns.");
  m.def("nested_dissection", &order<nested_dissection>, nb::arg("starts"), nb::arg("rows"),
        "Elimination order (n,) by nested dissection for a symmetric pattern, given by its "
        "columns.");
  nb::class_<ScalarFactor>(m, "ScalarFactor",
                           "Cholesky factor of a sparse symmetric matrix (n, n), given by its "
                           "columns with both triangles. Solves are for x, y and z at once.")
      .def(
          "__init__",
          [](ScalarFactor* self, IndexVectorIn starts, IndexVectorIn rows, VectorIn values) {
            new (self) ScalarFactor(sparse_matrix(starts, rows, values));
          },
          nb::arg("starts"), nb::arg("rows"), nb::arg("values"))
      .def_static("in_order", &in_order, nb::arg("starts"), nb::arg("rows"), nb::arg("values"),
                  nb::arg("order"), "The factor for a given elimination order (n,).")
      .def_prop_ro("nonzeros", &ScalarFactor::nonzeros)
      .def("solve", &solve<Packing::alone>, nb::arg("right_hand_side"),
           "Solution for one right-hand side (1, 3n).")
      .def("solve_lanes", &solve<Packing::lanes>, nb::arg("right_hand_sides"),
           "Solutions for up to lane_count right-hand sides (k, 3n), one per lane.")
      .def("solve_single_lanes", &solve<Packing::single_lanes>, nb::arg("right_hand_sides"),
           "`solve_lanes` in single precision, for up to twice as many right-hand sides.");
}

}  // namespace snapspace
