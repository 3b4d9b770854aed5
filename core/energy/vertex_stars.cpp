#include "energy/vertex_stars.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "material/shell_arap.h"
#include "mesh/incidence.h"

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
  constexpr int kStarsPerStop = 32;
  std::vector<SweepStop> stops;
  std::int32_t reached = 0;
  for (int star = 0; star < vertex_count; star += kStarsPerStop) {
    const std::int32_t end = std::min(star + kStarsPerStop, vertex_count);
    for (int c = first_corner[star]; c < first_corner[end]; ++c)
      reached = std::max(reached, corners[c] + 1);
    stops.push_back({end, reached, vertex_count});
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

VertexStars::VertexStars(const RestShape& rest, const TetMaterial& material)
    : weights(rest.vertex_count, 0.0), areas(rest.vertex_count, 0.0) {
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
    for (const std::int32_t vertex : triangle.vertices) {
      weights[vertex] += triangle.weight;
      areas[vertex] += tet.volume / 3.0;
    }
  }
  const Incidence incidence(rest.vertex_count, static_cast<int>(count),
                            [&](int t, int k) { return rest.tets[t].vertices[k]; });
  first_triangle_.push_back(0);
  for (std::int32_t vertex = 0; vertex < rest.vertex_count; ++vertex) {
    const auto around = incidence.around(vertex);
    triangles_.insert(triangles_.end(), around.begin(), around.end());
    first_triangle_.push_back(static_cast<std::int32_t>(triangles_.size()));
  }
  find_corners(rest.vertex_count);
  stops = star_stops(first_corner, corners, rest.vertex_count);
  find_couplings();
  gradients.resize(3 * corners.size());
  frames.resize(9 * weights.size());
  inverse_inertias_.resize(frames.size());
  for (int star = 0; star < this->count(); ++star) make_star(star);

  double_.gradients.assign(gradients.begin(), gradients.end());
  double_.frames.assign(frames.begin(), frames.end());
  single_.gradients.assign(gradients.begin(), gradients.end());
  single_.frames.assign(frames.begin(), frames.end());
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

void VertexStars::find_corners(int vertex_count) {
  first_corner.push_back(0);
  for (std::int32_t vertex = 0; vertex < vertex_count; ++vertex) {
    const std::size_t begin = corners.size();
    corners.push_back(vertex);
    for (int k = first_triangle_[vertex]; k < first_triangle_[vertex + 1]; ++k)
      for (const std::int32_t corner : double_.triangles[triangles_[k]].vertices)
        if (corner != vertex) corners.push_back(corner);
    const auto ring = corners.begin() + static_cast<std::ptrdiff_t>(begin) + 1;
    std::sort(ring, corners.end());
    corners.erase(std::unique(ring, corners.end()), corners.end());
    first_corner.push_back(static_cast<std::int32_t>(corners.size()));
  }
}

void VertexStars::find_couplings() {
  couplings.assign(corners.size(), 0.0);
  for (const Triangle<double>& triangle : double_.triangles) {
    const double hats[3][2] = {
        {-triangle.first[0], -triangle.first[1] - triangle.second},
        {triangle.first[0], triangle.first[1]},
        {0.0, triangle.second},
    };
    for (int j = 0; j < 3; ++j) {
      const std::int32_t star = triangle.vertices[j];
      const auto begin = corners.begin() + first_corner[star];
      const auto end = corners.begin() + first_corner[star + 1];
      for (int k = 0; k < 3; ++k) {
        const auto place = j == k ? begin : std::lower_bound(begin + 1, end, triangle.vertices[k]);
        couplings[place - corners.begin()] +=
            3.0 * triangle.weight * (hats[j][0] * hats[k][0] + hats[j][1] * hats[k][1]);
      }
    }
  }
}

void VertexStars::make_star(int star) {
  const auto frame_of = [](const Triangle<double>& triangle) {
    return Eigen::Map<const Eigen::Matrix<double, 3, 2, Eigen::RowMajor>>(&triangle.frame[0][0]);
  };
  const auto each = [&](const auto& act) {
    for (int k = first_triangle_[star]; k < first_triangle_[star + 1]; ++k) {
      const Triangle<double>& triangle = double_.triangles[triangles_[k]];
      act(triangle, triangle.weight / weights[star]);
    }
  };
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
  each([&](const auto& triangle, double share) {
    M += share * frame_of(triangle) * frame_of(triangle).transpose();
  });
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(M).eigenvectors();
  // summed anew, since the least eigenvalue of a nearly flat star is a small difference in M
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
      const auto place = triangle.vertices[k] == star
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

Eigen::SparseMatrix<double> VertexStars::remainder() const {
  std::vector<Eigen::Triplet<double>> entries;
  for (int star = 0; star < count(); ++star)
    for (int k = first_corner[star]; k < first_corner[star + 1]; ++k)
      entries.emplace_back(star, corners[k], couplings[k]);
  for (int star = 0; star < count(); ++star)
    for (int j = first_corner[star]; j < first_corner[star + 1]; ++j)
      for (int k = first_corner[star]; k < first_corner[star + 1]; ++k) {
        const double *a = &gradients[3 * std::size_t(j)], *b = &gradients[3 * std::size_t(k)];
        entries.emplace_back(corners[j], corners[k],
                             -weights[star] * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]));
      }
  Eigen::SparseMatrix<double> Q(count(), count());
  Q.setFromTriplets(entries.begin(), entries.end());
  return Q;
}

}  // namespace snapspace
