#include "mesh/rest_shape.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace snapspace {

RestShape::RestShape(const double* v, int n, const std::int32_t* t, int m)
    : tets(m), vertex_count(n) {
  for (int i = 0; i < m; ++i) {
    RestTet& tet = tets[i];
    std::copy_n(t + 4 * i, 4, tet.vertices);
    const Eigen::Vector3d origin(v + 3 * tet.vertices[0]);
    Eigen::Matrix3d edges;
    for (int j = 0; j < 3; ++j)
      edges.col(j) = Eigen::Vector3d(v + 3 * tet.vertices[j + 1]) - origin;
    tet.volume = std::abs(edges.determinant()) / 6.0;
    const Eigen::Matrix3d inverse = edges.inverse();
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) tet.inverse_edges[r][c] = inverse(r, c);
  }
}

Eigen::SparseMatrix<double> RestShape::laplacian() const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(tets.size() * 16);
  for (const RestTet& tet : tets) {
    Eigen::Matrix<double, 4, 3> gradients;  // of the four hat functions; they sum to zero
    for (int j = 0; j < 3; ++j) gradients.row(j + 1) = Eigen::RowVector3d(tet.inverse_edges[j]);
    gradients.row(0) = -gradients.bottomRows<3>().colwise().sum();
    const Eigen::Matrix4d local = tet.volume * gradients * gradients.transpose();
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        entries.emplace_back(tet.vertices[a], tet.vertices[b], local(a, b));
  }
  Eigen::SparseMatrix<double> L(vertex_count, vertex_count);
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

}  // namespace snapspace
