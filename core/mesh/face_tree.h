#pragma once
#include <Eigen/Geometry>
#include <cstdint>
#include <limits>
#include <vector>

namespace snapspace {

/// The face of a surface that is closest to a point.
struct ClosestFace {
  std::int32_t face = -1;  ///< -1 if no face is within the limit
  double squared_distance = std::numeric_limits<double>::infinity();
  /// The closest point on the face.
  Eigen::Vector3d foot = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
};

/// The triangles of a surface in a balanced tree of boxes, which finds the closest one to a point,
/// and those that a ray crosses.
class FaceTree {
 public:
  /// @param vertices  three coordinates for each
  /// @param faces     face_count x 3, at least one; a face may have no area
  FaceTree(const double* vertices, const std::int32_t* faces, int face_count);

  /// The faces closest to points, count x 3, and among equally close ones the first.
  /// @param limit  largest distance of interest
  void closest(const double* points, int count, double limit, int threads,
               ClosestFace* found) const;

  /// The winding numbers of a closed surface around points, count x 3: how often it encloses each.
  /// On the surface, the number is that of one of the sides.
  void windings(const double* points, int count, int threads, std::int32_t* found) const;

 private:
  /// A node's first child follows it. Leaves have a number of faces.
  struct Node {
    Eigen::AlignedBox3d box;
    std::int32_t first_face = 0, face_count = 0, second_child = 0;
  };
  using Triangle = Eigen::Matrix3d;  ///< its columns are the corners

  void add_node(const std::vector<Triangle>& triangles, int begin, int end);
  /// @param likely  the closest face of a point nearby, where the search begins, or -1
  [[nodiscard]] ClosestFace closest(const Eigen::Vector3d& point, double squared_limit,
                                    std::int32_t likely) const;
  void measure(int place, const Eigen::Vector3d& point, ClosestFace& best) const;
  [[nodiscard]] std::int32_t winding(const Eigen::Vector3d& point) const;

  double rounding_ = 0.0;  ///< bound on the error of a small squared distance
  std::vector<Node> nodes_;
  std::vector<std::int32_t> order_;   ///< the face in each place of the leaves
  std::vector<std::int32_t> places_;  ///< the place of each face
  std::vector<Triangle> triangles_;   ///< in this order
};

}  // namespace snapspace
