#include "reduction/strain_rows.h"

#include <cmath>

#include "online/quartic.h"
#include "simd/memory.h"

namespace snapspace {

StrainRows::StrainRows(const VertexModes& modes, int dimension)
    : modes_(modes),
      dimension_(dimension),
      packs_(modes.packs()),
      columns_(1 + dimension + static_cast<int>(online::pair_count(dimension))),
      stride_(static_cast<std::size_t>(columns_) + kWideLanes),
      gradients_(9 * packs_),
      rows_(6 * stride_) {}

void StrainRows::fill(const RestTet& tet, const Lame& lame) {
  static constexpr int kRow[6] = {0, 1, 2, 0, 0, 1};
  static constexpr int kColumn[6] = {0, 1, 2, 1, 2, 2};
  fill_gradients(tet);
  for (int s = 0; s < 6; ++s) fill_strain(kRow[s], kColumn[s], &rows_[s * stride_]);
  scale(tet.volume, lame);
}

void StrainRows::fill_gradients(const RestTet& tet) {
  const Wide* u[4];
  for (int v = 0; v < 4; ++v) u[v] = modes_.at(tet.vertices[v]);
  for (int r = 0; r < 3; ++r)
    for (int k = r * packs_; k < (r + 1) * packs_; ++k) {
      const Wide edges[3] = {u[1][k] - u[0][k], u[2][k] - u[0][k], u[3][k] - u[0][k]};
      for (int c = 0; c < 3; ++c)
        gradients_[(3 * r + c) * packs_ + k - r * packs_] =
            Wide(tet.inverse_edges[0][c]) * edges[0] + Wide(tet.inverse_edges[1][c]) * edges[1] +
            Wide(tet.inverse_edges[2][c]) * edges[2];
    }
}

/// Strain component (a, b): 1/2 (G + G^T + G^T G)_ab with G = G_offset + sum_i q_i G_i. Packs reach
/// beyond the end of their columns; the next columns overwrite the excess.
void StrainRows::fill_strain(int a, int b, double* row) const {
  const auto cross = [&](int i, int j) {  // 1/2 (G_i^T G_j + G_j^T G_i)_ab
    double sum = 0.0;
    for (int k = 0; k < 3; ++k)
      sum += gradient(k, a, i) * gradient(k, b, j) + gradient(k, b, i) * gradient(k, a, j);
    return 0.5 * sum;
  };
  const int offset = dimension_;
  row[0] = 0.5 * (gradient(a, b, offset) + gradient(b, a, offset) + cross(offset, offset));
  const auto crosses = [&](int j, int packs, double* out, auto begin_with) {
    Wide left[3], right[3];
    for (int k = 0; k < 3; ++k) {
      left[k] = Wide((a == b ? 1.0 : 0.5) * gradient(k, b, j));
      right[k] = Wide(0.5 * gradient(k, a, j));
    }
    for (int p = 0; p < packs; ++p) {
      Wide sum = begin_with(p);
      for (int k = 0; k < 3; ++k) sum += left[k] * gradient(k, a)[p];
      if (a != b)
        for (int k = 0; k < 3; ++k) sum += right[k] * gradient(k, b)[p];
      store(out + p * kWideLanes, sum);
    }
  };
  crosses(offset, packs_, row + 1,
          [&](int p) { return Wide(0.5) * (gradient(a, b)[p] + gradient(b, a)[p]); });
  double* out = row + 1 + dimension_;
  for (int j = 0; j < dimension_; ++j, out += j) {
    crosses(j, j / kWideLanes + 1, out, [](int) { return Wide(0.0); });
    out[j] *= 0.5;  // q_j^2 appears once in the sum over i and j, q_i q_j twice
  }
}

/// Scales by the square root of the density: strains E become rows shear * E_rc and diagonal * E_rr
/// + trace * tr(E), whose squares add up to volume * (mu |E|^2 + lam/2 tr(E)^2).
void StrainRows::scale(double volume, const Lame& lame) {
  const double diagonal = std::sqrt(volume * lame.mu), shear = std::sqrt(2.0 * volume * lame.mu);
  const double trace = (std::sqrt(volume * (lame.mu + 1.5 * lame.lam)) - diagonal) / 3.0;
  double* __restrict xx = rows_.data();
  double* __restrict yy = xx + stride_;
  double* __restrict zz = yy + stride_;
  for (int p = 0; p < columns_; ++p) {
    const double pressure = trace * (xx[p] + yy[p] + zz[p]);
    xx[p] = diagonal * xx[p] + pressure;
    yy[p] = diagonal * yy[p] + pressure;
    zz[p] = diagonal * zz[p] + pressure;
  }
  for (std::size_t p = 3 * stride_; p < 6 * stride_; ++p) rows_[p] *= shear;
}

}  // namespace snapspace
