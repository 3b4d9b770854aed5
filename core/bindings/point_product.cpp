#include "bindings/arrays.h"

namespace snapspace {

namespace {

/// product = (matrix (x) I3) points for a square sparse matrix given row by row. Indices are looked
/// at on the way: another pass over them would take a fourth of the time.
void point_product(const std::int32_t* starts, const std::int32_t* columns, const double* values,
                   std::size_t rows, std::size_t entries, const double* points, double* product) {
  std::size_t entry = 0;
  for (std::size_t row = 0; row < rows; ++row) {
    require(starts[row + 1] >= 0 && static_cast<std::size_t>(starts[row + 1]) <= entries,
            "starts reach beyond the entries");
    double x = 0.0, y = 0.0, z = 0.0;
    for (; entry < static_cast<std::size_t>(starts[row + 1]); ++entry) {
      const auto column = static_cast<std::size_t>(columns[entry]);
      require(column < rows, "a column is out of range");
      const double* point = points + 3 * column;
      x += values[entry] * point[0];
      y += values[entry] * point[1];
      z += values[entry] * point[2];
    }
    product[3 * row] = x;
    product[3 * row + 1] = y;
    product[3 * row + 2] = z;
  }
}

}  // namespace

void bind_point_product(nb::module_& m) {
  m.def(
      "point_product",
      [](IndexVectorIn starts, IndexVectorIn columns, VectorIn values, VectorIn points) {
        require(starts.size() >= 1 && starts.data()[0] == 0, "starts must be (n + 1,), from 0");
        require(columns.size() == values.size(), "one value per column is needed");
        require(points.size() == 3 * (starts.size() - 1), "needs a (3n,) vector");
        DoublesOut product = new_array<double>({points.size()});
        const nb::gil_scoped_release release;
        point_product(starts.data(), columns.data(), values.data(), starts.size() - 1,
                      values.size(), points.data(), product.data());
        return product;
      },
      nb::arg("starts"), nb::arg("columns"), nb::arg("values"), nb::arg("points"),
      "A sparse matrix (n, n), given row by row, times x, y and z of points (3n,).");
}

}  // namespace snapspace
