#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

namespace snapspace {

/// What a tetrahedron's energy needs of its rest shape.
struct RestTet {
  double inverse_edges[3][3];  ///< inverse of the matrix with columns v1 - v0, v2 - v0, v3 - v0
  double volume;               ///< positive, also where the tet is inverted in its rest shape
  std::int32_t vertices[4];
};

/// Rest shape of a tetrahedral mesh: shape-function gradients and volumes, tet by tet.
struct RestShape {
  std::vector<RestTet> tets;
  int vertex_count = 0;

  /// @param vertices  n x 3, row-major   @param tets  m x 4, row-major, none without volume
  RestShape(const double* vertices, int vertex_count, const std::int32_t* tets, int tet_count);

  /// Scalar stiffness matrix of the linear elements (the cotangent Laplacian of tets), n x n,
  /// positive semi-definite.
  [[nodiscard]] Eigen::SparseMatrix<double> laplacian() const;
};

}  // namespace snapspace
