#include "energy/vertex_stars.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "material/shell_arap.h"

namespace snapspace {

namespace {

/// Mean squared sines between the planes of a star and one normal, below which it is flat.
constexpr double kFlat = 1e-20;

/// The tangent frame of a triangle, in its row of the material.
Eigen::Matrix<double, 3, 2> tangents(const double* row) {
  double L[3][3];
  ShellArap::frame(row, L);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(&L[0][0]).leftCols<2>();
}

/// Stops of a pass over the stars, as `sweep_stops` makes them for tets.
std::vector<SweepStop> star_stops(const std::vector<std::int32_t>& first_corner,
                                  const std::vector<std::int32_t>& corners, int vertex_count) {
  constexpr int kCornersPerStop = 224;
  const auto count = static_cast<int>(first_corner.size()) - 1;
  std::vector<SweepStop> stops;
  std::int32_t reached = 0;
  for (int star = 0, last = 0; star < count; ++star) {
    for (int c = first_corner[star]; c < first_corner[star + 1]; ++c)
      reached = std::max(reached, corners[c] + 1);
    if (first_corner[star + 1] - first_corner[last] < kCornersPerStop && star + 1 < count) continue;
    stops.push_back({star + 1, reached, vertex_count});
    last = star + 1;
  }
  stops.back().reached = vertex_count;
  std::int32_t complete = vertex_count;
  for (std::size_t k = stops.size(); k-- > 0;) {
    stops[k].complete = std::min(complete, stops[k].reached);
    const int begin = k == 0 ? 0 : stops[k - 1].tets;
    for (int c = first_corner[begin]; c < first_corner[stops[k].tets]; ++c)
      complete = std::min(complete, corners[c]);
  }
  return stops;
}

}  // namespace

VertexStars::VertexStars(const RestShape& rest, const TetMaterial& material, const StarHats& hats) {
  const auto count = rest.tets.size();
  double_.triangles.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const RestTet& tet = rest.tets[t];
    const double* row = material.of(static_cast<int>(t));
    Triangle<double>& triangle = double_.triangles[t];
    std::copy_n(tet.inverse_edges[0], 2, triangle.first);
    triangle.second = tet.inverse_edges[1][1];
    const Eigen::Matrix<double, 3, 2> frame = tangents(row);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 2; ++c) triangle.frame[r][c] = frame(r, c);
    triangle.weight = tet.volume * row[0] / 3.0;
    std::copy_n(tet.vertices, 3, triangle.vertices);
  }
  const Incidence incidence(rest.vertex_count, static_cast<int>(count),
                            [&](int t, int k) { return rest.tets[t].vertices[k]; });
  find_triangles(incidence, rest.vertex_count, hats);
  find_couplings(incidence, rest.vertex_count);
  weights.assign(first_triangle.size() - 1, 0.0);
  areas.assign(weights.size(), 0.0);
  for (int star = 0; star < this->count(); ++star)
    for (int k = first_triangle[star]; k < first_triangle[star + 1]; ++k) {
      weights[star] += shares[k] * double_.triangles[triangles[k]].weight;
      areas[star] += shares[k] * rest.tets[triangles[k]].volume / 3.0;
    }
  find_corners(hats);
  stops = star_stops(first_corner, corners, rest.vertex_count);
  gradients.resize(3 * corners.size());
  frames.resize(9 * weights.size());
  inverse_inertias_.resize(frames.size());
  for (int star = 0; star < this->count(); ++star) make_star(star);

  double_.gradients.assign(gradients.begin(), gradients.end());
  double_.frames.assign(frames.begin(), frames.end());
  double_.shares.assign(shares.begin(), shares.end());
  single_.gradients.assign(gradients.begin(), gradients.end());
  single_.frames.assign(frames.begin(), frames.end());
  single_.shares.assign(shares.begin(), shares.end());
  single_.triangles.resize(count);
  for (std::size_t t = 0; t < count; ++t) {
    const Triangle<double>& from = double_.triangles[t];
    Triangle<float>& to = single_.triangles[t];
    std::copy_n(from.first, 2, to.first);
    to.second = static_cast<float>(from.second);
    std::copy_n(&from.frame[0][0], 6, &to.frame[0][0]);
    to.weight = static_cast<float>(from.weight);
    std::copy_n(from.vertices, 3, to.vertices);
  }
}

void VertexStars::find_triangles(const Incidence& incidence, int vertex_count,
                                 const StarHats& hats) {
  first_triangle.push_back(0);
  if (hats.of_all_vertices()) {
    for (std::int32_t vertex = 0; vertex < vertex_count; ++vertex) {
      const auto around = incidence.around(vertex);
      triangles.insert(triangles.end(), around.begin(), around.end());
      first_triangle.push_back(static_cast<std::int32_t>(triangles.size()));
    }
    shares.assign(triangles.size(), 1.0);
    return;
  }
  std::vector<double> share(double_.triangles.size(), 0.0);
  for (int star = 0; star < hats.count(); ++star) {
    const std::size_t begin = triangles.size();
    for (int k = hats.first[star]; k < hats.first[star + 1]; ++k)
      for (const std::int32_t triangle : incidence.around(hats.vertices[k])) {
        if (share[triangle] == 0.0) triangles.push_back(triangle);
        share[triangle] += hats.weights[k];
      }
    std::sort(triangles.begin() + static_cast<std::ptrdiff_t>(begin), triangles.end());
    for (std::size_t k = begin; k < triangles.size(); ++k)
      shares.push_back(std::exchange(share[triangles[k]], 0.0));
    first_triangle.push_back(static_cast<std::int32_t>(triangles.size()));
  }
}

void VertexStars::find_corners(const StarHats& hats) {
  first_corner.push_back(0);
  for (int star = 0; star < count(); ++star) {
    const std::int32_t center = hats.of_all_vertices() ? star : hats.vertices[hats.first[star]];
    const std::size_t begin = corners.size();
    corners.push_back(center);
    for (int k = first_triangle[star]; k < first_triangle[star + 1]; ++k)
      for (const std::int32_t corner : double_.triangles[triangles[k]].vertices)
        if (corner != center) corners.push_back(corner);
    const auto others = corners.begin() + static_cast<std::ptrdiff_t>(begin) + 1;
    std::sort(others, corners.end());
    corners.erase(std::unique(others, corners.end()), corners.end());
    first_corner.push_back(static_cast<std::int32_t>(corners.size()));
  }
}

void VertexStars::find_couplings(const Incidence& incidence, int vertex_count) {
  first_neighbour.push_back(0);
  std::vector<std::pair<std::int32_t, double>> pairs;
  for (std::int32_t vertex = 0; vertex < vertex_count; ++vertex) {
    pairs.clear();
    for (const std::int32_t t : incidence.around(vertex)) {
      const Triangle<double>& triangle = double_.triangles[t];
      const double hats[3][2] = {
          {-triangle.first[0], -triangle.first[1] - triangle.second},
          {triangle.first[0], triangle.first[1]},
          {0.0, triangle.second},
      };
      const auto j =
          std::find(triangle.vertices, triangle.vertices + 3, vertex) - triangle.vertices;
      for (int k = 0; k < 3; ++k)
        if (k != j)
          pairs.emplace_back(
              triangle.vertices[k],
              3.0 * triangle.weight * (hats[j][0] * hats[k][0] + hats[j][1] * hats[k][1]));
    }
    // in the order of the triangles, so that sums round alike
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      if (k > 0 && pairs[k].first == pairs[k - 1].first) {
        couplings.back() += pairs[k].second;
      } else {
        neighbours.push_back(pairs[k].first);
        couplings.push_back(pairs[k].second);
      }
    }
    first_neighbour.push_back(static_cast<std::int32_t>(neighbours.size()));
  }
}

void VertexStars::make_star(int star) {
  const auto frame_of = [](const Triangle<double>& triangle) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 2, Eigen::RowMajor>>(&triangle.frame[0][0]);
  };
  const auto each = [&](const auto& act) {
    for (int k = first_triangle[star]; k < first_triangle[star + 1]; ++k) {
      const Triangle<double>& triangle = double_.triangles[triangles[k]];
      act(triangle, shares[k] * triangle.weight / weights[star]);
    }
  };
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  each([&](const auto& triangle, double share) {
    M += share * frame_of(triangle) * frame_of(triangle).transpose();
  });
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(M).eigenvectors();
  // summed again, since the smallest eigenvalue of a nearly flat star is a small difference in M
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();
  each([&](const auto& triangle, double share) {
    squares += share * (axes.transpose() * frame_of(triangle)).rowwise().squaredNorm();
  });
  Eigen::Vector3d inverse_roots = Eigen::Vector3d::Zero(), roots = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (squares[k] > kFlat) {
      roots[k] = std::sqrt(squares[k]);
      inverse_roots[k] = 1.0 / roots[k];
    }
  using Rows = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Eigen::Map<Rows>(frames.data() + 9 * star) = axes * roots.asDiagonal();
  Eigen::Map<Rows>(inverse_inertias_.data() + 9 * star) =
      (M.trace() * Eigen::Matrix3d::Identity() - M).inverse();

  const auto begin = corners.begin() + first_corner[star];
  const auto end = corners.begin() + first_corner[star + 1];
  each([&](const auto& triangle, double share) {
    Eigen::Matrix<double, 3, 2> hats;
    hats.row(1) << triangle.first[0], triangle.first[1];
    hats.row(2) << 0.0, triangle.second;
    hats.row(0) = -hats.row(1) - hats.row(2);
    const Eigen::Matrix3d in_space =
        share * hats * frame_of(triangle).transpose() * axes * inverse_roots.asDiagonal();
    for (int k = 0; k < 3; ++k) {
      const auto place = triangle.vertices[k] == *begin
                             ? begin
                             : std::lower_bound(begin + 1, end, triangle.vertices[k]);
      Eigen::Map<Eigen::RowVector3d>(gradients.data() + 3 * (place - corners.begin())) +=
          in_space.row(k);
    }
  });
}

void VertexStars::write_numbers(int star, double* numbers) const {
  const double* L = &frames[9 * static_cast<std::size_t>(star)];
  std::fill_n(numbers, ShellArap::kScaled, 0.0);
  numbers[0] = 1.0;
  for (int r = 0; r < 3; ++r) {
    std::copy_n(L + 3 * r, 2, numbers + ShellArap::kScaled + 2 * r);
    numbers[ShellArap::kScaled + 6 + r] = L[3 * r + 2];
  }
}

}  // namespace snapspace
