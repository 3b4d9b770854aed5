#include "mesh/face_tree.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

#include "threads/parallel.h"

namespace snapspace {

namespace {

using Eigen::Vector3d;

constexpr int leaf_faces = 4;
/// The tree halves the faces, so 2^31 of them take 30 levels, with one waiting node on each.
constexpr int most_waiting = 40;
/// Points in a row of one thread, which start from each other's closest faces.
constexpr int chunk = 256;
/// Relative rounding error of a squared distance, and its error near a surface, relative to the
/// square of the coordinates. A box that is as close as the best face up to these is searched, too:
/// it may contain a face that is equally close.
constexpr double relative_error = 1e-12, small_error = 1e-18;

Vector3d closest_on_edge(const Vector3d& start, const Vector3d& end, const Vector3d& point) {
  const Vector3d edge = end - start;
  const double length = edge.squaredNorm();
  const double share = length > 0.0 ? (point - start).dot(edge) / length : 0.0;
  return start + std::clamp(share, 0.0, 1.0) * edge;
}

/// The foot of the perpendicular if it falls inside the triangle, else the closest point on an
/// edge. That is well defined for triangles without area, too.
Vector3d closest_on_triangle(const Eigen::Matrix3d& corners, const Vector3d& point) {
  const Vector3d first = corners.col(1) - corners.col(0), second = corners.col(2) - corners.col(0);
  const Vector3d normal = first.cross(second), offset = point - corners.col(0);
  const double area = normal.squaredNorm();
  if (area > 0.0) {
    const double v = offset.cross(second).dot(normal) / area;
    const double w = first.cross(offset).dot(normal) / area;
    if (v >= 0.0 && w >= 0.0 && v + w <= 1.0) return corners.col(0) + v * first + w * second;
  }
  Vector3d best = corners.col(0);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vector3d one = closest_on_edge(corners.col(k), corners.col((k + 1) % 3), point);
    const double squared = (one - point).squaredNorm();
    if (squared < least) std::tie(best, least) = std::tuple(one, squared);
  }
  return best;
}

/// How often a triangle encloses a point in the projection along x: 1 or -1, depending on its
/// orientation, or 0. An edge counts as crossed on one side only and from its lower end, so that
/// triangles with a common edge agree, whatever the rounding.
int projected_winding(const Eigen::Matrix3d& corners, const Vector3d& point) {
  int winding = 0;
  for (int k = 0; k < 3; ++k) {
    const Vector3d start = corners.col(k), end = corners.col((k + 1) % 3);
    const bool rises = end.z() > point.z();
    if (rises == (start.z() > point.z())) continue;
    const Vector3d &low = rises ? start : end, &high = rises ? end : start;
    const double side =
        (high.y() - low.y()) * (point.z() - low.z()) - (point.y() - low.y()) * (high.z() - low.z());
    if (side > 0.0) winding += rises ? 1 : -1;
  }
  return winding;
}

}  // namespace

FaceTree::FaceTree(const double* vertices, const std::int32_t* faces, int face_count)
    : order_(face_count), places_(face_count) {
  std::vector<Triangle> triangles(face_count);
  for (int face = 0; face < face_count; ++face)
    for (int corner = 0; corner < 3; ++corner)
      triangles[face].col(corner) = Eigen::Map<const Vector3d>(
          vertices + 3 * static_cast<std::size_t>(faces[3 * std::size_t(face) + corner]));
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(2 * static_cast<std::size_t>(face_count) / leaf_faces + 1);
  add_node(triangles, 0, face_count);
  const Eigen::AlignedBox3d& all = nodes_[0].box;
  rounding_ = small_error * all.min().cwiseAbs().cwiseMax(all.max().cwiseAbs()).squaredNorm();
  triangles_.reserve(face_count);
  for (int place = 0; place < face_count; ++place) {
    places_[order_[place]] = place;
    triangles_.push_back(triangles[order_[place]]);
  }
}

void FaceTree::add_node(const std::vector<Triangle>& triangles, int begin, int end) {
  Eigen::AlignedBox3d corners, middles;
  for (int place = begin; place < end; ++place) {
    const Triangle& triangle = triangles[order_[place]];
    for (int corner = 0; corner < 3; ++corner) corners.extend(Vector3d(triangle.col(corner)));
    middles.extend(Vector3d(triangle.rowwise().sum()));
  }
  const std::size_t node = nodes_.size();
  nodes_.push_back({corners, begin});
  if (end - begin <= leaf_faces) {
    nodes_[node].face_count = end - begin;
    return;
  }
  int axis = 0;
  middles.sizes().maxCoeff(&axis);
  const int half = begin + (end - begin) / 2;
  const auto place_of = [&](std::int32_t face) {
    return std::tuple(triangles[face].row(axis).sum(), face);
  };
  std::nth_element(order_.begin() + begin, order_.begin() + half, order_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) { return place_of(a) < place_of(b); });
  add_node(triangles, begin, half);
  nodes_[node].second_child = static_cast<std::int32_t>(nodes_.size());
  add_node(triangles, half, end);
}

void FaceTree::measure(int place, const Vector3d& point, ClosestFace& best) const {
  const Vector3d foot = closest_on_triangle(triangles_[place], point);
  const double squared = (foot - point).squaredNorm();
  const std::int32_t face = order_[place];
  if (squared < best.squared_distance ||
      (squared == best.squared_distance && (best.face < 0 || face < best.face)))
    best = {face, squared, foot};
}

ClosestFace FaceTree::closest(const Vector3d& point, double squared_limit,
                              std::int32_t likely) const {
  ClosestFace best;
  best.squared_distance = squared_limit;
  if (likely >= 0) measure(places_[likely], point, best);
  std::array<std::pair<std::int32_t, double>, most_waiting> waiting;
  int count = 0;
  waiting[count++] = {0, nodes_[0].box.squaredExteriorDistance(point)};
  while (count > 0) {
    const auto [index, gap] = waiting[--count];
    if (gap > (1.0 + relative_error) * best.squared_distance + rounding_) continue;
    const Node& node = nodes_[index];
    for (int k = 0; k < node.face_count; ++k) measure(node.first_face + k, point, best);
    if (node.face_count > 0) continue;
    std::pair<std::int32_t, double> near{index + 1,
                                         nodes_[index + 1].box.squaredExteriorDistance(point)},
        far{node.second_child, nodes_[node.second_child].box.squaredExteriorDistance(point)};
    if (far.second < near.second) std::swap(near, far);
    waiting[count++] = far;
    waiting[count++] = near;
  }
  if (best.face < 0) best.squared_distance = std::numeric_limits<double>::infinity();
  return best;
}

void FaceTree::closest(const double* points, int count, double limit, int threads,
                       ClosestFace* found) const {
  parallel_for((count + chunk - 1) / chunk, threads, [&](int part) {
    std::int32_t likely = -1;
    for (int k = part * chunk; k < std::min(count, (part + 1) * chunk); ++k) {
      const Eigen::Map<const Vector3d> point(points + 3 * static_cast<std::size_t>(k));
      found[k] = closest(point, limit * limit, likely);
      likely = found[k].face;
    }
  });
}

std::int32_t FaceTree::winding(const Vector3d& point) const {
  std::int32_t sum = 0;
  std::array<std::int32_t, most_waiting> waiting;
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::int32_t index = waiting[--count];
    const Node& node = nodes_[index];
    const Vector3d &low = node.box.min(), &high = node.box.max();
    if (high.x() < point.x() || low.y() > point.y() || high.y() < point.y() ||
        low.z() > point.z() || high.z() < point.z())
      continue;
    for (int k = 0; k < node.face_count; ++k) {
      const Triangle& corners = triangles_[node.first_face + k];
      const int winding = projected_winding(corners, point);
      if (winding == 0) continue;
      const Vector3d start = corners.col(0);
      const Vector3d normal = (corners.col(1) - start).cross(corners.col(2) - start);
      if (winding * normal.dot(start - point) > 0.0) sum += winding;
    }
    if (node.face_count > 0) continue;
    waiting[count++] = node.second_child;
    waiting[count++] = index + 1;
  }
  return sum;
}

void FaceTree::windings(const double* points, int count, int threads, std::int32_t* found) const {
  parallel_for((count + chunk - 1) / chunk, threads, [&](int part) {
    for (int k = part * chunk; k < std::min(count, (part + 1) * chunk); ++k)
      found[k] = winding(Eigen::Map<const Vector3d>(points + 3 * static_cast<std::size_t>(k)));
  });
}

}  // namespace snapspace
