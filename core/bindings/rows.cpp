#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "snapshots/combine_rows.h"
#include "snapshots/mass_products.h"

namespace snapspace {

namespace {

std::vector<const double*> addresses(const std::vector<VectorIn>& rows, std::size_t size) {
  std::vector<const double*> result;
  for (const VectorIn& row : rows) {
    require(row.size() == size, "all rows must have the same length");
    result.push_back(row.data());
  }
  return result;
}

ScalarRows scalar_rows(const IndexVectorIn& starts, const IndexVectorIn& columns,
                       const VectorIn& values) {
  require(starts.size() >= 1 && starts.data()[0] == 0, "starts must be (n + 1,), from 0");
  require(columns.size() == values.size(), "one value per column is needed");
  const std::size_t size = starts.size() - 1;
  for (std::size_t i = 0; i < size; ++i)
    require(starts.data()[i] <= starts.data()[i + 1], "starts must not decrease");
  require(static_cast<std::size_t>(starts.data()[size]) <= values.size(),
          "starts reach beyond the entries");
  for (std::size_t entry = 0; entry < columns.size(); ++entry)
    require(columns.data()[entry] >= 0 && static_cast<std::size_t>(columns.data()[entry]) < size,
            "a column is out of range");
  return {size, starts.data(), columns.data(), values.data()};
}

/// MassProducts does not copy the arrays of the matrix, so this keeps them alive.
struct HeldMassProducts {
  IndexVectorIn starts, columns;
  VectorIn values;
  std::size_t size = starts.size() - 1;
  MassProducts products{scalar_rows(starts, columns, values)};

  DoublesOut multiply(const std::vector<VectorIn>& rows, const std::optional<VectorIn>& offset,
                      const std::vector<VectorIn>& others, int threads) {
    const auto left = addresses(rows, 3 * size), right = addresses(others, 3 * size);
    require(!offset || offset->size() == 3 * size, "the offset must be (3n,)");
    DoublesOut result = new_array<double>({left.size(), right.size()});
    const ReleasedGil released;
    products.multiply(left, offset ? offset->data() : nullptr, right, threads, result.data());
    return result;
  }
};

}  // namespace

void bind_rows(nb::module_& m) {
  nb::class_<HeldMassProducts>(
      m, "MassProducts",
      "Inner products of displacements (3n,) with respect to a scalar matrix (n, n), given row by "
      "row. Only one thread may use it at a time.")
      .def(
          "__init__",
          [](HeldMassProducts* self, IndexVectorIn starts, IndexVectorIn columns, VectorIn values) {
            new (self) HeldMassProducts{starts, columns, values};
          },
          nb::arg("starts"), nb::arg("columns"), nb::arg("values"))
      .def("multiply", &HeldMassProducts::multiply, nb::arg("rows"), nb::arg("offset").none(),
           nb::arg("others"), nb::kw_only(), nb::arg("threads"),
           "Products (i, j) of rows[i] + offset with M (x) I3 times others[j].");
  m.def(
      "combine_rows",
      [](std::vector<VectorIn> rows, std::size_t size, MatrixIn weights, int threads) {
        const auto from = addresses(rows, size);
        require(weights.shape(1) == from.size(), "one column of weights per row is needed");
        DoublesOut combined = new_array<double>({weights.shape(0), size});
        const ReleasedGil released;
        combine_rows(from, size, weights.data(), weights.shape(0), combined.data(), threads);
        return combined;
      },
      nb::arg("rows"), nb::arg("size"), nb::arg("weights"), nb::kw_only(), nb::arg("threads"),
      "Combinations (j, size) of i rows (size,): weights (j, i) times rows.");
}

}  // namespace snapspace
