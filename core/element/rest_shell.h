#pragma once
#include <cmath>

#include "element/rest_tet.h"

/// Triangles and hinges as elements of four corners, so that a shell passes through the same code
/// as a solid. A triangle a b c has the corners a, b, c, c. A hinge has the corners v0, v1 of its
/// edge, and v2, v3 of the triangles v0 v1 v2 and v1 v0 v3 beside it.
///
/// Their `inverse_edges` map the displacements of edges from the first corner to a 3 x 3 matrix G,
/// as those of a tet map them to its displacement gradient. For a triangle, the first two columns
/// of G are its displacement gradient (3 x 2); for a hinge, G has the displacements of the three
/// edges in units of the rest edge. The `volume` of a triangle is its area. That of a hinge is a
/// third of the area of both triangles over the mean square of its angle on cylinders of radius one
/// that touch it in all directions. Then hinges of any shape have the energy of a plate on average,
/// and those of equilateral triangles have the usual |edge|^2 / (sum of both areas).
namespace snapspace {

[[nodiscard]] inline bool is_triangle(const std::int32_t corners[4]) {
  return corners[2] == corners[3];
}

/// The rest shape of a triangle or a hinge between rows of `vertices` (n x 3). No triangle may be
/// without area.
class RestShellElement {
 public:
  RestShellElement(const double* vertices, const std::int32_t corners[4]) : corners_(corners) {
    for (int j = 0; j < 3; ++j)
      for (int r = 0; r < 3; ++r)
        edges_[j][r] = vertices[3 * corners[j + 1] + r] - vertices[3 * corners[0] + r];
    length_ = std::sqrt(dot(edges_[0], edges_[0]));
    cross(edges_[0], edges_[1], normal_);
    twice_area_ = std::sqrt(dot(normal_, normal_));
  }

  [[nodiscard]] RestTet element() const {
    RestTet result = {};
    for (int corner = 0; corner < 4; ++corner) result.vertices[corner] = corners_[corner];
    if (is_triangle(corners_)) {
      // The inverse of the edges' coordinates in the tangent frame, whose first vector is along the
      // first edge.
      const double height = twice_area_ / length_;
      result.inverse_edges[0][0] = 1.0 / length_;
      result.inverse_edges[0][1] = -dot(edges_[0], edges_[1]) / (length_ * twice_area_);
      result.inverse_edges[1][1] = 1.0 / height;
      result.volume = 0.5 * twice_area_;
      return result;
    }
    for (int j = 0; j < 3; ++j) result.inverse_edges[j][j] = 1.0 / length_;
    double other[3];
    cross(edges_[2], edges_[0], other);
    const double other_twice = std::sqrt(dot(other, other));
    result.volume = (twice_area_ + other_twice) / 6.0 / mean_square_angle(other_twice);
    return result;
  }

  /// Four times the product of the areas of a hinge's triangles.
  [[nodiscard]] double area_product() const {
    double other[3];
    cross(edges_[2], edges_[0], other);
    return twice_area_ * std::sqrt(dot(other, other));
  }

  /// Writes the numbers of the rest shape that follow the moduli of a ShellDensity, except those of
  /// the rest angle.
  /// @param product  for a hinge, the area_product() at which bending has its full stiffness
  void write_numbers(double* numbers, double product) const {
    for (int r = 0; r < 3; ++r) {
      if (is_triangle(corners_)) {
        const int s = (r + 1) % 3, t = (r + 2) % 3;
        numbers[2 * r] = edges_[0][r] / length_;
        numbers[2 * r + 1] =
            (normal_[s] * edges_[0][t] - normal_[t] * edges_[0][s]) / (twice_area_ * length_);
      } else {
        for (int j = 0; j < 3; ++j) numbers[1 + 3 * r + j] = edges_[j][r] / length_;
      }
    }
    const double square = length_ * length_;  // areas in units of the edge
    if (!is_triangle(corners_)) numbers[10] = product / square / square;
  }

  /// Bounded, so that a surface may be folded at rest.
  [[nodiscard]] double half_angle_tangent() const {
    double other[3];
    cross(edges_[2], edges_[0], other);
    const double sine = length_ * dot(normal_, edges_[2]), cosine = dot(normal_, other);
    const double length = twice_area_ * std::sqrt(dot(other, other));
    const double flat = length + cosine;
    return sine / (flat > kFolded * length ? flat : kFolded * length);
  }

 private:
  static double dot(const double* x, const double* y) {
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
  }
  static void cross(const double* x, const double* y, double* result) {
    for (int r = 0; r < 3; ++r) {
      const int s = (r + 1) % 3, t = (r + 2) % 3;
      result[r] = x[s] * y[t] - x[t] * y[s];
    }
  }

  /// Mean square over directions of the angle on a cylinder of radius one, for small hinges. With
  /// the hinge unfolded into the plane, heights z of the corners bend it by the product of `row`
  /// and z. For z = (x . direction)^2 / 2 the angle is a quadratic form Q of the direction, and the
  /// mean of its square is (2 |Q|^2 + tr(Q)^2) / 8.
  [[nodiscard]] double mean_square_angle(double other_twice) const {
    const double first = twice_area_ / length_, second = other_twice / length_;  // heights
    const double x[3] = {length_, dot(edges_[0], edges_[1]) / length_,
                         dot(edges_[0], edges_[2]) / length_};
    const double y[3] = {0.0, first, -second};
    const double row[3] = {-(x[1] / first + x[2] / second) / length_, 1.0 / first, 1.0 / second};
    double xx = 0.0, yy = 0.0, xy = 0.0;
    for (int j = 0; j < 3; ++j) {
      xx += 0.5 * row[j] * x[j] * x[j];
      yy += 0.5 * row[j] * y[j] * y[j];
      xy += 0.5 * row[j] * x[j] * y[j];
    }
    return (2.0 * (xx * xx + yy * yy + 2.0 * xy * xy) + (xx + yy) * (xx + yy)) / 8.0;
  }

  static constexpr double kFolded = 1e-6;

  const std::int32_t* corners_;
  double edges_[3][3];  // edge by edge
  double normal_[3];    // normal of the first triangle, as long as twice its area
  double length_, twice_area_;
};

}  // namespace snapspace
