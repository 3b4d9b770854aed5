#include "online/cubature.h"

#include <algorithm>

#include "material/element_hessian.h"
#include "online/block_sums.h"
#include "online/tet_density.h"

namespace snapspace::online {

Cubature::Cubature(int dimension, int tets, const float* rows, const double* weights,
                   const TetMaterial& material, const RowClusters& clusters)
    : rows_(dimension, tets, rows, clusters),
      second_half_(static_cast<std::size_t>(dimension) * dimension),
      kind_(material.kind),
      moduli_count_(material_moduli(material.kind)),
      moduli_(static_cast<std::size_t>(rows_.blocks()) * moduli_count_, Tets(0.0)) {
  double weighted[kMaxModuli];
  for (int tet = 0; tet < tets; ++tet) {
    scale_moduli(kind_, material.of(tet), weights[tet], weighted);
    for (int k = 0; k < moduli_count_; ++k)
      moduli_[tet / TetRows::kWidth * moduli_count_ + k].set(tet % TetRows::kWidth, weighted[k]);
  }
}

Cubature::Tets Cubature::block_energy(int block, const Tets G[3][3], Tets P[3][3]) const {
  return value_and_stress(kind_, moduli_.data() + block * moduli_count_, G, P);
}

double Cubature::value_and_gradient(const double* q, double* gradient) {
  return block_sum(rows_, half_runner_, q, *this, gradient);
}

/// Weighted Hessians (9 x 9) of a block's tets with respect to their displacement gradients; zero
/// for lanes without a tet.
void Cubature::block_curvatures(int block, const Tets G[3][3], Tets hessian[9][9]) const {
  for (int f = 0; f < 9; ++f) std::fill_n(hessian[f], 9, Tets(0.0));
  for (int lane = 0; lane < rows_.lanes(block); ++lane) {
    double moduli[kMaxModuli], gradient[3][3], curvature[9][9];
    for (int k = 0; k < moduli_count_; ++k) moduli[k] = moduli_[block * moduli_count_ + k][lane];
    for (int e = 0; e < 9; ++e) gradient[e / 3][e % 3] = G[e / 3][e % 3][lane];
    element_hessian({kind_, 1, moduli}, 0, gradient, curvature);
    for (int e = 0; e < 81; ++e) hessian[e / 9][e % 9].set(lane, curvature[e / 9][e % 9]);
  }
}

double Cubature::derivatives(const double* q, double* gradient, double* hessian) {
  const double value = value_and_gradient(q, gradient);
  const auto d = static_cast<std::size_t>(dimension());
  std::fill_n(hessian, d * d, 0.0);
  add_block_hessians(rows_, half_runner_, second_half_, *this, hessian);
  return value;
}

void Cubature::curvatures(const double* q, float* hessians) {
  rows_.begin(q);
  rows_.store_curvatures(*this, hessians);
}

void Cubature::stresses(const double* q, float* stresses) {
  rows_.begin(q);
  rows_.store_stresses(*this, stresses);
}

}  // namespace snapspace::online
