#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "element/rest_tet.h"
#include "memory/streamed_vector.h"
#include "mesh/sweep.h"

namespace snapspace {

/// Rest shape of a mesh: shape-function gradients and volumes, tet by tet. The elements of a shell
/// are triangles and hinges, which have the form of tets, see element/rest_shell.h.
struct RestShape {
  StreamedVector<RestTet> tets;
  StreamedVector<RestTetOf<float>> single_tets;  ///< the same, for packs in single precision
  std::vector<SweepStop> stops;                  ///< stops of a pass over the tets
  int vertex_count = 0;
  bool shell = false;

  /// @param vertices  n x 3, row-major   @param tets  m x 4, row-major, none without volume
  /// @param shell  whether they are triangles and hinges
  RestShape(const double* vertices, int vertex_count, const std::int32_t* tets, int tet_count,
            bool shell = false);

  /// The tets in the precision of T, float or double.
  template <class T>
  [[nodiscard]] const StreamedVector<RestTetOf<T>>& tets_in() const {
    if constexpr (std::is_same_v<T, float>)
      return single_tets;
    else
      return tets;
  }

  /// A quarter of the volume of the tets at each vertex, or a third of the area of the triangles,
  /// as a share of the whole.
  [[nodiscard]] std::vector<float> lumped_shares() const;

  /// n x n matrix that is the sum of one 4 x 4 matrix per tet.
  [[nodiscard]] Eigen::SparseMatrix<double> assembled(
      const std::vector<Eigen::Matrix4d>& locals) const;
};

/// Gradients of the four hat functions of a tet, or of the three of a triangle and a row of zeros,
/// one per row; they sum to zero.
[[nodiscard]] Eigen::Matrix<double, 4, 3> hat_gradients(const RestTet& tet);

}  // namespace snapspace
