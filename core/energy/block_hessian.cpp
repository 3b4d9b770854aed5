#include "energy/block_hessian.h"

#include <algorithm>

#include "material/element_hessian.h"

namespace snapspace {

namespace {

/// The curvature of a tet at a displacement gradient, projected.
PrincipalCurvature curvature_of(const TetMaterial& material, int tet, const double (&stretches)[3],
                                Projection projection, double threshold) {
  double s[3];
  for (int i = 0; i < 3; ++i)
    s[i] = projection == Projection::stretches ? std::max(stretches[i], threshold) : stretches[i];
  return projected(material.curvature(tet, s), projection);
}

/// Adds the second derivative of psi with respect to the displacements of vertices j and k: dF = u
/// (x) b, with u in the frame of U and the gradients b of the hat functions in the frame of V.
void add_block(const PrincipalCurvature& H, const double (&U)[3][3], const double* b_j,
               const double* b_k, double weight, double* block) {
  double local[3][3], half[3][3];
  for (int i = 0; i < 3; ++i) {
    const int j = kPairs[i][0], k = kPairs[i][1];
    local[i][i] = H.scaling[i][i] * b_j[i] * b_k[i] + H.same(k) * b_j[j] * b_k[j] +
                  H.same(j) * b_j[k] * b_k[k];
    local[j][k] = H.scaling[j][k] * b_j[j] * b_k[k] + H.cross(i) * b_j[k] * b_k[j];
    local[k][j] = H.scaling[k][j] * b_j[k] * b_k[j] + H.cross(i) * b_j[j] * b_k[k];
  }
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      half[r][c] = U[r][0] * local[0][c] + U[r][1] * local[1][c] + U[r][2] * local[2][c];
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      block[3 * r + c] +=
          weight * (half[r][0] * U[c][0] + half[r][1] * U[c][1] + half[r][2] * U[c][2]);
}

/// The gradients of a tet's hat functions times a matrix with the given columns.
void hat_gradients(const RestTet& tet, const double (&columns)[3][3], double (&b)[4][3]) {
  for (int c = 0; c < 3; ++c) {
    b[0][c] = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double* edge = tet.inverse_edges[k];
      b[k + 1][c] = edge[0] * columns[0][c] + edge[1] * columns[1][c] + edge[2] * columns[2][c];
      b[0][c] -= b[k + 1][c];
    }
  }
}

}  // namespace

BlockHessian::BlockHessian(const RestShape& rest) : BlockHessian(rest, nullptr) {}

BlockHessian::BlockHessian(const ElasticEnergy& energy)
    : BlockHessian(energy.rest, energy.stars ? &*energy.stars : nullptr) {}

BlockHessian::BlockHessian(const RestShape& rest, const VertexStars* stars)
    : slots_(rest.tets.size()) {
  std::vector<std::vector<std::int32_t>> neighbours(rest.vertex_count);
  for (const RestTet& tet : rest.tets)
    for (const std::int32_t a : tet.vertices)
      neighbours[a].insert(neighbours[a].end(), tet.vertices, tet.vertices + 4);
  for (int star = 0; stars && star < stars->count(); ++star) {
    const auto begin = stars->corners.begin() + stars->first_corner[star];
    const auto end = stars->corners.begin() + stars->first_corner[star + 1];
    for (auto a = begin; a != end; ++a) neighbours[*a].insert(neighbours[*a].end(), begin, end);
  }
  row_start_.reserve(rest.vertex_count + 1);
  row_start_.push_back(0);
  for (auto& row : neighbours) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    columns_.insert(columns_.end(), row.begin(), row.end());
    row_start_.push_back(static_cast<std::int32_t>(columns_.size()));
  }
  blocks_.resize(columns_.size());
  for (std::size_t t = 0; t < rest.tets.size(); ++t)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        const std::int32_t row = rest.tets[t].vertices[a];
        const auto begin = columns_.begin() + row_start_[row];
        const auto end = columns_.begin() + row_start_[row + 1];
        const auto at = std::lower_bound(begin, end, rest.tets[t].vertices[b]);
        slots_[t][4 * a + b] = static_cast<std::int32_t>(at - columns_.begin());
      }
}

void BlockHessian::clear() { std::fill(blocks_.begin(), blocks_.end(), std::array<double, 9>{}); }

void BlockHessian::add(const ElasticEnergy& energy, const double* u, Projection projection,
                       double threshold, double weight) {
  if (energy.stars) return add_stars(energy, u, projection, weight);
  for (int t = 0; t < energy.tets(); ++t) add_tet(energy, t, u, projection, threshold, weight);
}

void BlockHessian::add(const ElasticEnergy& energy, const double* u, Projection projection,
                       double threshold, const double* weights) {
  for (int t = 0; t < energy.tets(); ++t) add_tet(energy, t, u, projection, threshold, weights[t]);
}

void BlockHessian::add_tet(const ElasticEnergy& energy, int t, const double* u,
                           Projection projection, double threshold, double weight) {
  const RestTet& tet = energy.rest.tets[t];
  if (energy.rest.shell) return add_shell_element(energy, t, u, projection, weight);
  double F[3][3], b[4][3];  // b in the frame of V
  displacement_gradient(tet, u, F);
  for (int r = 0; r < 3; ++r) F[r][r] += 1.0;
  const SignedSvd svd(F);
  const PrincipalCurvature H =
      curvature_of(energy.material.view(), t, svd.s, projection, threshold);
  hat_gradients(tet, svd.V, b);
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k)
      add_block(H, svd.U, b[j], b[k], weight * tet.volume, blocks_[slots_[t][4 * j + k]].data());
}

void BlockHessian::add_shell_element(const ElasticEnergy& energy, int t, const double* u,
                                     Projection projection, double weight) {
  constexpr double kIdentity[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const RestTet& element = energy.rest.tets[t];
  double G[3][3], H[9][9], b[4][3];
  displacement_gradient(element, u, G);
  element_hessian(energy.material.view(), t, G, H);
  project(H, projection);
  hat_gradients(element, kIdentity, b);
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k) {
      double* block = blocks_[slots_[t][4 * j + k]].data();
      for (int e = 0; e < 9; ++e)
        for (int f = 0; f < 9; ++f)
          block[3 * (e / 3) + f / 3] +=
              weight * element.volume * b[j][e % 3] * H[e][f] * b[k][f % 3];
    }
}

/// Adds the Laplacian of the triangles and, for each star, the Hessian of its density less that of
/// |G|^2, which the Laplacian contains.
void BlockHessian::add_stars(const ElasticEnergy& energy, const double* u, Projection projection,
                             double weight) {
  const VertexStars& stars = *energy.stars;
  for (int t = 0; t < energy.tets(); ++t) {
    const RestTet& triangle = energy.rest.tets[t];
    const double stiffness =
        weight * triangle.volume * energy.material.view().small_strains(t).stiffness();
    const Eigen::Matrix4d local = stiffness * snapspace::hat_gradients(triangle) *
                                  snapspace::hat_gradients(triangle).transpose();
    for (int e = 0; e < 16; ++e)
      for (int r = 0; r < 3; ++r) blocks_[slots_[t][e]][4 * r] += local(e / 4, e % 4);
  }
  for (int star = 0; star < stars.count(); ++star) {
    double numbers[ShellArap::kModuli], G[3][3], H[9][9];
    stars.write_numbers(star, numbers);
    stars.gradient_of(star, u, G);
    ShellArap::hessian(numbers, G, H);
    project(H, projection);
    for (int e = 0; e < 9; ++e) H[e][e] -= 2.0;
    const double scale = weight * stars.weights[star];
    for (int j = stars.first_corner[star]; j < stars.first_corner[star + 1]; ++j)
      for (int k = stars.first_corner[star]; k < stars.first_corner[star + 1]; ++k) {
        double* const to = block(stars.corners[j], stars.corners[k]);
        const double *a = &stars.gradients[3 * std::size_t(j)],
                     *b = &stars.gradients[3 * std::size_t(k)];
        for (int e = 0; e < 9; ++e)
          for (int f = 0; f < 9; ++f)
            to[3 * (e / 3) + f / 3] += scale * a[e % 3] * H[e][f] * b[f % 3];
      }
  }
}

double* BlockHessian::block(std::int32_t row, std::int32_t column) {
  const auto begin = columns_.begin() + row_start_[row];
  const auto end = columns_.begin() + row_start_[row + 1];
  return blocks_[std::lower_bound(begin, end, column) - columns_.begin()].data();
}

void BlockHessian::add_outer_product(int tet, const double (&forces)[4][3], double weight) {
  for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k) {
      double* block = blocks_[slots_[tet][4 * j + k]].data();
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) block[3 * r + c] += weight * forces[j][r] * forces[k][c];
    }
}

void BlockHessian::add_to_diagonal(int vertex, double value) {
  double* const diagonal = block(vertex, vertex);
  for (int r = 0; r < 3; ++r) diagonal[4 * r] += value;
}

void BlockHessian::multiply(const double* v, double* product) const {
  const std::size_t n = row_start_.size() - 1;
  for (std::size_t row = 0; row < n; ++row) {
    double sum[3] = {};
    for (std::int32_t k = row_start_[row]; k < row_start_[row + 1]; ++k) {
      const double *block = blocks_[k].data(), *x = v + 3 * static_cast<std::size_t>(columns_[k]);
      for (int r = 0; r < 3; ++r)
        sum[r] += block[3 * r] * x[0] + block[3 * r + 1] * x[1] + block[3 * r + 2] * x[2];
    }
    std::copy_n(sum, 3, product + 3 * row);
  }
}

}  // namespace snapspace
