#include "mesh/face_tree.h"

#include <cmath>
#include <tuple>

#include "bindings/arrays.h"
#include "bindings/released_gil.h"

namespace snapspace {

namespace {

std::tuple<IndicesOut, DoublesOut, DoublesOut> closest(const FaceTree& tree, MatrixIn points,
                                                       double limit, int threads) {
  require(points.shape(1) == 3, "points must be (k, 3)");
  const std::size_t count = points.shape(0);
  std::vector<ClosestFace> found(count);
  {
    const ReleasedGil released;
    tree.closest(points.data(), static_cast<int>(count), limit, threads, found.data());
  }
  IndicesOut faces = new_array<std::int32_t>({count});
  DoublesOut distances = new_array<double>({count}), feet = new_array<double>({count, 3});
  for (std::size_t k = 0; k < count; ++k) {
    faces.data()[k] = found[k].face;
    distances.data()[k] = std::sqrt(found[k].squared_distance);
    std::copy_n(found[k].foot.data(), 3, feet.data() + 3 * k);
  }
  return {faces, distances, feet};
}

IndicesOut windings(const FaceTree& tree, MatrixIn points, int threads) {
  require(points.shape(1) == 3, "points must be (k, 3)");
  IndicesOut found = new_array<std::int32_t>({points.shape(0)});
  const ReleasedGil released;
  tree.windings(points.data(), static_cast<int>(points.shape(0)), threads, found.data());
  return found;
}

}  // namespace

void bind_face_tree(nb::module_& m) {
  nb::class_<FaceTree>(m, "FaceTree",
                       "The triangles (f, 3) of a surface with vertices (n, 3), for searches of "
                       "closest faces, and for winding numbers.")
      .def(
          "__init__",
          [](FaceTree* self, MatrixIn vertices, IndexMatrixIn faces) {
            require(vertices.shape(1) == 3, "vertices must be (n, 3)");
            require(faces.shape(1) == 3 && faces.shape(0) > 0, "faces must be (f, 3), f > 0");
            require_below(faces, vertices.shape(0), "a face has a vertex that does not exist");
            const ReleasedGil released;
            new (self) FaceTree(vertices.data(), faces.data(), static_cast<int>(faces.shape(0)));
          },
          nb::arg("vertices"), nb::arg("faces"))
      .def("closest", &closest, nb::arg("points"), nb::arg("limit"), nb::arg("threads") = 0,
           "The face closest to each point (k, 3), the first of equally close ones, or -1 if none "
           "is within the limit; its distance, or inf; and the closest point on it (k, 3), or nan. "
           "threads: 0 for all.")
      .def("windings", &windings, nb::arg("points"), nb::arg("threads") = 0,
           "How often a closed surface encloses each point (k, 3). threads: 0 for all.");
}

}  // namespace snapspace
