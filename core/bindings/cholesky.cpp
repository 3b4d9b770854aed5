#include <Eigen/SparseCore>

#include "bindings/arrays.h"
#include "cholesky/orderings.h"
#include "simd/lanes.h"
#include "snapshots/scalar_factor.h"
#include "threads/flush_denormals.h"

namespace snapspace {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix matrix(IndexVectorIn starts, IndexVectorIn rows, const double* values) {
  require(starts.size() >= 2 && starts.data()[0] == 0, "starts must be (n + 1,), from 0");
  const std::size_t n = starts.size() - 1;
  for (std::size_t j = 0; j < n; ++j)
    require(starts.data()[j] <= starts.data()[j + 1], "starts must not decrease");
  require(static_cast<std::size_t>(starts.data()[n]) == rows.size(), "one row per entry is needed");
  for (std::size_t i = 0; i < rows.size(); ++i)
    require(rows.data()[i] >= 0 && static_cast<std::size_t>(rows.data()[i]) < n,
            "a row is out of range");
  const auto size = static_cast<Eigen::Index>(n);
  return Eigen::Map<const Matrix>(size, size, static_cast<Eigen::Index>(rows.size()), starts.data(),
                                  rows.data(), values);
}

Matrix matrix(IndexVectorIn starts, IndexVectorIn rows, VectorIn values) {
  require(rows.size() == values.size(), "one value per row is needed");
  return matrix(starts, rows, values.data());
}

template <std::vector<std::int32_t> (*Order)(const Matrix&)>
IndicesOut order(IndexVectorIn starts, IndexVectorIn rows) {
  const std::vector<double> ones(rows.size(), 1.0);
  const std::vector<std::int32_t> result = Order(matrix(starts, rows, ones.data()));
  return copy_to_array(result.data(), {result.size()});
}

ScalarFactor in_order(IndexVectorIn starts, IndexVectorIn rows, VectorIn values,
                      IndexVectorIn elimination) {
  const Matrix A = matrix(starts, rows, values);
  const std::vector<std::int32_t> given(elimination.data(),
                                        elimination.data() + elimination.size());
  std::vector<std::int32_t> sorted = given;
  std::sort(sorted.begin(), sorted.end());
  bool all = sorted.size() == starts.size() - 1;
  for (std::size_t i = 0; i < sorted.size(); ++i) all = all && sorted[i] == static_cast<int>(i);
  require(all, "the order must have every vertex once");
  return {A, Supernodes(A, given)};
}

/// All right-hand sides (k, 3n) at once, k up to the width; Real is double or a pack.
template <class Real, int Width>
DoublesOut solve(const ScalarFactor& factor, MatrixIn right_hand_sides) {
  const std::size_t count = right_hand_sides.shape(0), size = right_hand_sides.shape(1);
  require(size == 3 * factor.size() && count <= Width, "needs (k, 3n), and k no more than lanes");
  const FlushDenormals flush;
  std::vector<Real> packed(size, Real(0));
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < size; ++i)
      set_lane(packed[i], static_cast<int>(k), right_hand_sides(k, i));
  factor.solve(packed.data(), packed.data());
  DoublesOut result = new_array<double>({count, size});
  for (std::size_t k = 0; k < count; ++k)
    for (std::size_t i = 0; i < size; ++i) {
      if constexpr (Width == 1)
        result.data()[i] = packed[i];
      else
        result.data()[k * size + i] = packed[i][static_cast<int>(k)];
    }
  return result;
}

}  // namespace

void bind_cholesky(nb::module_& m) {
  constexpr int kSingle = 2 * kWideLanes;
  m.def("minimum_degree", &order<minimum_degree>, nb::arg("starts"), nb::arg("rows"),
        "Order of elimination (n,) of a symmetric pattern, given by its columns.");
  m.def("nested_dissection", &order<nested_dissection>, nb::arg("starts"), nb::arg("rows"),
        "The same by nested dissection.");
  nb::class_<ScalarFactor>(m, "ScalarFactor",
                           "Cholesky factor of a sparse matrix (n, n), given by its columns with "
                           "both triangles; it solves for x, y and z.")
      .def(
          "__init__",
          [](ScalarFactor* self, IndexVectorIn starts, IndexVectorIn rows, VectorIn values) {
            new (self) ScalarFactor(matrix(starts, rows, values));
          },
          nb::arg("starts"), nb::arg("rows"), nb::arg("values"))
      .def_static("in_order", &in_order, nb::arg("starts"), nb::arg("rows"), nb::arg("values"),
                  nb::arg("order"), "The factor for an order of elimination (n,).")
      .def_prop_ro("nonzeros", &ScalarFactor::nonzeros)
      .def("solve", &solve<double, 1>, nb::arg("right_hand_side"), "Solution of one (1, 3n).")
      .def("solve_lanes", &solve<Lanes<kWideLanes>, kWideLanes>, nb::arg("right_hand_sides"),
           "Solutions of up to lane_count (k, 3n), one per lane.")
      .def("solve_single_lanes", &solve<SingleLanes<kSingle>, kSingle>, nb::arg("right_hand_sides"),
           "The same in single precision, of up to twice as many.");
}

}  // namespace snapspace
