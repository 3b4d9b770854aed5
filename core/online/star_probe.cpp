#include "online/star_probe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "online/reconstruct.h"
#include "online/tet_density.h"

namespace snapspace::online {

StarProbe::StarProbe(const ProbeStars& stars, const ProbePins& pins)
    : ResidualProbe(stars.dimension, stars.poses),
      stars_(stars.stars),
      kind_(stars.material.kind),
      size_(9 * static_cast<std::size_t>(stars.stars) + 3 * static_cast<std::size_t>(stars.places)),
      origins_(stars.origins, stars.origins + stars.poses * size_),
      moduli_(stars.material.moduli,
              stars.material.moduli +
                  static_cast<std::size_t>(stars.material.rows) * material_moduli(kind_)),
      modes_(stars.modes, stars.modes + stars.poses * stars.dimension * size_),
      part_stars_(stars.part_stars, stars.part_stars + stars.parts),
      part_places_(stars.part_places, stars.part_places + stars.parts),
      part_vectors_(stars.part_vectors,
                    stars.part_vectors + 3 * static_cast<std::size_t>(stars.poses) * stars.parts),
      weights_(stars.weights, stars.weights + stars.places),
      pins_(pins),
      numbers_(size_),
      stresses_(9 * static_cast<std::size_t>(stars.stars)),
      gradient_(3 * static_cast<std::size_t>(stars.places)) {}

double StarProbe::norm(const double* q, int dimension, const double* offsets,
                       const double* weights) {
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  for (int k = 0; k < rests(); ++k) {
    const double weight = weights ? weights[k] : 1.0;
    if (weight == 0.0) continue;
    reconstruct(size_, dimension, origins_.data() + k * size_,
                modes_.data() + k * this->dimension() * size_, q, numbers_.data());
    find_stresses(moduli_.data() + k * (moduli_.size() / rests()));
    const double* linear = numbers_.data() + stresses_.size();
    for (double& g : gradient_) g += weight * *linear++;
    const double* vector = part_vectors_.data() + k * 3 * part_stars_.size();
    for (std::size_t i = 0; i < part_stars_.size(); ++i, vector += 3) {
      const double* P = stresses_.data() + 9 * static_cast<std::size_t>(part_stars_[i]);
      double* g = gradient_.data() + 3 * static_cast<std::size_t>(part_places_[i]);
      for (int r = 0; r < 3; ++r, P += 3)
        g[r] += weight * (P[0] * vector[0] + P[1] * vector[1] + P[2] * vector[2]);
    }
  }
  if (offsets) pins_.subtract_wanted(offsets, gradient_.data());
  double sum = 0.0;
  const double* g = gradient_.data();
  for (const double weighted : weights_) {
    sum += weighted * (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    g += 3;
  }
  return std::sqrt(sum);
}

void StarProbe::find_stresses(const double* moduli) {
  using Stars = TetRows::Tets;
  const int width = material_moduli(kind_);
  for (int begin = 0; begin < stars_; begin += TetRows::kWidth) {
    const int lanes = std::min(TetRows::kWidth, stars_ - begin);
    Stars numbers[kMaxModuli], H[3][3], P[3][3];
    std::fill_n(numbers, kMaxModuli, Stars(0.0));
    for (auto& row : H) std::fill_n(row, 3, Stars(0.0));
    for (int lane = 0; lane < lanes; ++lane) {
      const double* own = numbers_.data() + 9 * static_cast<std::size_t>(begin + lane);
      for (int e = 0; e < 9; ++e) H[e / 3][e % 3].set(lane, own[e]);
      for (int i = 0; i < width; ++i) numbers[i].set(lane, *moduli++);
    }
    (void)value_and_stress(kind_, numbers, H, P);
    double* to = stresses_.data() + 9 * static_cast<std::size_t>(begin);
    for (int lane = 0; lane < lanes; ++lane)
      for (int e = 0; e < 9; ++e) *to++ = P[e / 3][e % 3][lane];
  }
}

}  // namespace snapspace::online
