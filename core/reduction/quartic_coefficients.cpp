#include "reduction/quartic_coefficients.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "online/quartic.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

constexpr int kPanelTets = 512;
constexpr int kBlock = 128;

/// Column of the pair (i, j), i <= j, behind the constant and the d linear columns.
int pair_column(int dimension, int i, int j) { return 1 + dimension + j * (j + 1) / 2 + i; }

/// Square root of the density: turns strains into rows whose squares add up to
/// mu |E|^2 + lam/2 tr(E)^2.
struct StrainRoot {
  double shear;  // times each off-diagonal entry
  double diagonal;
  double trace;  // sqrt(mu) E_rr + trace * tr(E)
  explicit StrainRoot(const StVK& m)
      : shear(std::sqrt(2.0 * m.mu)),
        diagonal(std::sqrt(m.mu)),
        trace((std::sqrt(m.mu + 1.5 * m.lam) - std::sqrt(m.mu)) / 3.0) {}
};

/// Six rows of A for one tet, each contiguous over the columns.
class PanelRows {
 public:
  PanelRows(const ElasticEnergy& energy, const double* modes, int dimension)
      : energy_(energy), modes_(modes), d_(dimension), root_(energy.material), gradients_(9) {
    for (auto& g : gradients_) g.resize(dimension + 1);
  }

  void fill(const RestTet& tet, double* rows, std::size_t stride) {
    const std::size_t shape_size = 3 * static_cast<std::size_t>(energy_.rest.vertex_count);
    for (int i = 0; i <= d_; ++i) {
      double G[3][3];
      displacement_gradient(tet, modes_ + i * shape_size, G);
      for (int c = 0; c < 9; ++c) gradients_[c][i] = G[c / 3][c % 3];
    }
    static constexpr int kRow[6] = {0, 1, 2, 0, 0, 1};
    static constexpr int kColumn[6] = {0, 1, 2, 1, 2, 2};
    for (int s = 0; s < 6; ++s) strain(kRow[s], kColumn[s], rows + s * stride);
    scale(rows, stride, std::sqrt(tet.volume));
  }

 private:
  /// Strain component (a, b): 1/2 (G + G^T + G^T G)_ab with G = sum_i x_i G_i, x = (1, q).
  void strain(int a, int b, double* row) const {
    const auto quadratic = [&](int i, int j) {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k)
        sum += gradients_[3 * k + a][i] * gradients_[3 * k + b][j] +
               gradients_[3 * k + b][i] * gradients_[3 * k + a][j];
      return 0.5 * sum;
    };
    const auto linear = [&](int i) {
      return 0.5 * (gradients_[3 * a + b][i] + gradients_[3 * b + a][i]);
    };
    row[0] = linear(0) + 0.5 * quadratic(0, 0);
    for (int i = 1; i <= d_; ++i) row[i] = linear(i) + quadratic(0, i);
    double* out = row + 1 + d_;
    for (int j = 1; j <= d_; ++j) {
      const double* g[6];
      double h[6];
      for (int k = 0; k < 3; ++k) {
        g[k] = gradients_[3 * k + a].data() + 1;
        g[k + 3] = gradients_[3 * k + b].data() + 1;
        h[k] = 0.5 * gradients_[3 * k + b][j];
        h[k + 3] = 0.5 * gradients_[3 * k + a][j];
      }
      for (int i = 0; i < j; ++i)
        out[i] = g[0][i] * h[0] + g[1][i] * h[1] + g[2][i] * h[2] + g[3][i] * h[3] +
                 g[4][i] * h[4] + g[5][i] * h[5];
      out[j - 1] *= 0.5;  // x_j^2 appears once in the sum over i and j, x_i x_j twice
      out += j;
    }
  }

  void scale(double* rows, std::size_t stride, double root_volume) const {
    const std::size_t columns = 1 + d_ + online::pair_count(d_);
    const double diagonal = root_volume * root_.diagonal;
    const double trace = root_volume * root_.trace;
    const double shear = root_volume * root_.shear;
    double* xx = rows;
    double* yy = rows + stride;
    double* zz = rows + 2 * stride;
    for (std::size_t p = 0; p < columns; ++p) {
      const double pressure = trace * (xx[p] + yy[p] + zz[p]);
      xx[p] = diagonal * xx[p] + pressure;
      yy[p] = diagonal * yy[p] + pressure;
      zz[p] = diagonal * zz[p] + pressure;
    }
    for (int s = 3; s < 6; ++s)
      for (std::size_t p = 0; p < columns; ++p) rows[s * stride + p] *= shear;
  }

  const ElasticEnergy& energy_;
  const double* modes_;
  int d_;
  StrainRoot root_;
  std::vector<std::vector<double>> gradients_;  // nine entries of G, each over the modes
};

/// Upper triangle of A^T A.
Eigen::MatrixXd gram_matrix(const ElasticEnergy& energy, const double* modes, int dimension,
                            int threads) {
  const int columns = 1 + dimension + static_cast<int>(online::pair_count(dimension));
  const int tets = static_cast<int>(energy.rest.tets.size());
  const int blocks = (columns + kBlock - 1) / kBlock;
  std::vector<std::array<int, 2>> block_pairs;
  for (int J = 0; J < blocks; ++J)
    for (int I = 0; I <= J; ++I) block_pairs.push_back({I, J});

  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(columns, columns);
  // A^T: its columns are rows of A.
  Eigen::MatrixXd panel(columns, 6 * std::min(kPanelTets, tets));
  for (int begin = 0; begin < tets; begin += kPanelTets) {
    const int count = std::min(kPanelTets, tets - begin);
    constexpr int kSlice = 64;
    parallel_for((count + kSlice - 1) / kSlice, threads, [&](int slice) {
      PanelRows rows(energy, modes, dimension);
      for (int t = slice * kSlice; t < std::min(count, (slice + 1) * kSlice); ++t)
        rows.fill(energy.rest.tets[begin + t], panel.col(6 * t).data(), columns);
    });
    const auto filled = panel.leftCols(6 * count);
    parallel_for(static_cast<int>(block_pairs.size()), threads, [&](int item) {
      const auto [I, J] = block_pairs[item];
      const int rows = std::min(kBlock, columns - I * kBlock);
      const int cols = std::min(kBlock, columns - J * kBlock);
      gram.block(I * kBlock, J * kBlock, rows, cols).noalias() +=
          filled.middleRows(I * kBlock, rows) * filled.middleRows(J * kBlock, cols).transpose();
    });
  }
  return gram;
}

/// Place of the monomial x_i x_j x_k x_l in online::Quartic's order; the indices come in any order.
std::size_t monomial(std::array<int, 4> index) {
  std::sort(index.begin(), index.end());
  const std::size_t i = index[0], j = index[1], k = index[2], l = index[3];
  return online::quartic_count(l) + k * (k + 1) * (k + 2) / 6 + online::pair_count(j) + i;
}

}  // namespace

std::vector<double> quartic_coefficients(const ElasticEnergy& energy, const double* modes,
                                         int dimension, int threads) {
  const Eigen::MatrixXd gram = gram_matrix(energy, modes, dimension, threads);
  // Factors (i, j) of x = (1, q) that each column of A stands for.
  std::vector<std::array<int, 2>> factors(gram.cols());
  for (int j = 0; j <= dimension; ++j)
    for (int i = 0; i <= j; ++i)
      factors[i == 0 ? j : pair_column(dimension, i - 1, j - 1)] = {i, j};

  std::vector<double> coefficients(online::quartic_count(dimension + 1), 0.0);
  for (Eigen::Index b = 0; b < gram.cols(); ++b)
    for (Eigen::Index a = 0; a <= b; ++a)
      coefficients[monomial({factors[a][0], factors[a][1], factors[b][0], factors[b][1]})] +=
          (a == b ? 1.0 : 2.0) * gram(a, b);
  return coefficients;
}

}  // namespace snapspace
