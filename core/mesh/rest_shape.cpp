#include "mesh/rest_shape.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "element/rest_shell.h"
#include "mesh/incidence.h"

namespace snapspace {

namespace {

RestTet rest_tet(const double* v, const std::int32_t* corners) {
  RestTet tet;
  std::copy_n(corners, 4, tet.vertices);
  const Eigen::Vector3d origin(v + 3 * tet.vertices[0]);
  Eigen::Matrix3d edges;
  for (int j = 0; j < 3; ++j) edges.col(j) = Eigen::Vector3d(v + 3 * tet.vertices[j + 1]) - origin;
  tet.volume = std::abs(edges.determinant()) / 6.0;
  const Eigen::Matrix3d inverse = edges.inverse();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) tet.inverse_edges[r][c] = inverse(r, c);
  return tet;
}

}  // namespace

RestShape::RestShape(const double* v, int n, const std::int32_t* t, int m, bool of_shell)
    : tets(m), single_tets(m), stops(sweep_stops(t, m, n)), vertex_count(n), shell(of_shell) {
  for (int i = 0; i < m; ++i) {
    RestTet& tet = tets[i];
    tet = shell ? RestShellElement(v, t + 4 * i).element() : rest_tet(v, t + 4 * i);
    RestTetOf<float>& single = single_tets[i];
    std::copy_n(tet.vertices, 4, single.vertices);
    std::copy_n(&tet.inverse_edges[0][0], 9, &single.inverse_edges[0][0]);
    single.volume = static_cast<float>(tet.volume);
  }
}

std::vector<float> RestShape::lumped_shares() const {
  const int corners = shell ? 3 : 4;
  const auto has_mass = [&](const RestTet& tet) { return !shell || is_triangle(tet.vertices); };
  double whole = 0.0;
  for (const RestTet& tet : tets)
    if (has_mass(tet)) whole += tet.volume;
  std::vector<float> shares(vertex_count, 0.0f);
  for (const RestTet& tet : tets)
    for (int k = 0; k < corners && has_mass(tet); ++k)
      shares[tet.vertices[k]] += static_cast<float>(1.0 / corners * tet.volume / whole);
  return shares;
}

Eigen::SparseMatrix<double> RestShape::assembled(const std::vector<Eigen::Matrix4d>& locals) const {
  // Each column is summed from the tets around its vertex. Triplets of all entries would take seven
  // times as many bytes as the matrix, and new memory is slow.
  const Incidence incidence(vertex_count, static_cast<int>(tets.size()),
                            [&](int tet, int k) { return tets[tet].vertices[k]; });
  Eigen::SparseMatrix<double> A(vertex_count, vertex_count);
  std::vector<double> sums(vertex_count, 0.0);
  std::vector<std::int32_t> last(vertex_count, -1), rows;  // last: the last column that has the row
  for (std::int32_t column = 0; column < vertex_count; ++column) {
    rows.clear();
    for (const std::int32_t tet : incidence.around(column)) {
      const auto& corners = tets[tet].vertices;
      const auto b = std::find(corners, corners + 4, column) - corners;
      for (int a = 0; a < 4; ++a) {
        if (std::exchange(last[corners[a]], column) != column) rows.push_back(corners[a]);
        sums[corners[a]] += locals[tet](a, b);
      }
    }
    std::sort(rows.begin(), rows.end());
    A.startVec(column);
    for (const std::int32_t row : rows) A.insertBack(row, column) = std::exchange(sums[row], 0.0);
  }
  A.finalize();
  return A;
}

Eigen::Matrix<double, 4, 3> hat_gradients(const RestTet& tet) {
  Eigen::Matrix<double, 4, 3> gradients;
  for (int j = 0; j < 3; ++j) gradients.row(j + 1) = Eigen::RowVector3d(tet.inverse_edges[j]);
  gradients.row(0) = -gradients.bottomRows<3>().colwise().sum();
  return gradients;
}

}  // namespace snapspace
