#include "online/blended_stars.h"

#include <algorithm>

#include "material/element_hessian.h"
#include "online/block_sums.h"
#include "online/tet_density.h"

namespace snapspace::online {

BlendedStars::BlendedStars(int dimension, const PoseStars& stars)
    : rows_(dimension, stars.poses * stars.stars, stars.rows),
      second_half_(static_cast<std::size_t>(dimension) * dimension),
      kind_(stars.material.kind),
      moduli_count_(material_moduli(stars.material.kind)),
      weights_(stars.poses, 0.0),
      areas_(rows_.tets()),
      origins_(9 * static_cast<std::size_t>(rows_.blocks()), Tets(0.0)),
      moduli_(static_cast<std::size_t>(rows_.blocks()) * moduli_count_, Tets(0.0)) {
  const std::size_t size = static_cast<std::size_t>(dimension + 1) * (dimension + 1);
  forms_.assign(stars.forms, stars.forms + size * stars.poses);
  form_.assign(size, 0.0);
  double numbers[kMaxModuli];
  for (int pair = 0; pair < rows_.tets(); ++pair) {
    const int block = pair / TetRows::kWidth, lane = pair % TetRows::kWidth;
    scale_moduli(kind_, stars.material.of(pair), stars.weights[pair % stars.stars], numbers);
    areas_[pair] = numbers[0];
    for (int k = 1; k < moduli_count_; ++k)
      moduli_[block * moduli_count_ + k].set(lane, numbers[k]);
    for (int e = 0; e < 9; ++e)
      origins_[9 * block + e].set(lane, stars.origins[9 * static_cast<std::size_t>(pair) + e]);
  }
}

void BlendedStars::set_weights(const double* weights) {
  const int stars = rows_.tets() / poses();
  for (int pose = 0; pose < poses(); ++pose) {
    const double weight = weights[pose];
    if (weight == weights_[pose]) continue;
    for (int pair = pose * stars; pair < (pose + 1) * stars; ++pair)
      moduli_[pair / TetRows::kWidth * moduli_count_].set(pair % TetRows::kWidth,
                                                          weight * areas_[pair]);
  }
  std::copy_n(weights, poses(), weights_.data());
  rows_.set_active([&](int block) {
    const int first = block * TetRows::kWidth, last = first + rows_.lanes(block) - 1;
    return std::any_of(weights_.begin() + first / stars, weights_.begin() + last / stars + 1,
                       [](double weight) { return weight != 0.0; });
  });
  std::fill(form_.begin(), form_.end(), 0.0);
  for (int pose = 0; pose < poses(); ++pose) {
    const double weight = weights_[pose];
    if (weight == 0.0) continue;
    const double* own = forms_.data() + pose * form_.size();
    for (double& entry : form_) entry += weight * *own++;
  }
}

/// The nine numbers of a block's stars, from those of the modes.
void BlendedStars::add_origins(int block, const Tets modes[3][3], Tets G[3][3]) const {
  for (int e = 0; e < 9; ++e) G[e / 3][e % 3] = modes[e / 3][e % 3] + origins_[9 * block + e];
}

BlendedStars::Tets BlendedStars::block_energy(int block, const Tets modes[3][3],
                                              Tets P[3][3]) const {
  Tets G[3][3];
  add_origins(block, modes, G);
  return value_and_stress(kind_, moduli_.data() + block * moduli_count_, G, P);
}

/// Adds the gradient of the quadratic form, and returns its value.
double BlendedStars::add_form(const double* q, double* gradient) const {
  const int d = dimension(), stride = capacity() + 1;
  const double* last = form_.data() + static_cast<std::size_t>(stride - 1) * stride;
  double value = last[stride - 1];
  for (int i = 0; i < d; ++i) {
    const double* row = form_.data() + static_cast<std::size_t>(i) * stride;
    double slope = last[i];
    for (int j = 0; j < d; ++j) slope += row[j] * q[j];
    value += q[i] * (slope + last[i]);
    gradient[i] += 2.0 * slope;
  }
  return value;
}

double BlendedStars::value_and_gradient(const double* q, double* gradient) {
  const double value = block_sum(rows_, half_runner_, q, *this, gradient);
  return value + add_form(q, gradient);
}

/// Weighted Hessians (9 x 9) of a block's stars; zero for lanes without a star.
void BlendedStars::block_curvatures(int block, const Tets modes[3][3], Tets hessian[9][9]) const {
  Tets G[3][3];
  add_origins(block, modes, G);
  for (int f = 0; f < 9; ++f) std::fill_n(hessian[f], 9, Tets(0.0));
  for (int lane = 0; lane < rows_.lanes(block); ++lane) {
    double moduli[kMaxModuli], gradient[3][3], curvature[9][9];
    for (int k = 0; k < moduli_count_; ++k) moduli[k] = moduli_[block * moduli_count_ + k][lane];
    if (moduli[0] == 0.0) continue;
    for (int e = 0; e < 9; ++e) gradient[e / 3][e % 3] = G[e / 3][e % 3][lane];
    element_hessian({kind_, 1, moduli}, 0, gradient, curvature);
    for (int e = 0; e < 81; ++e) hessian[e / 9][e % 9].set(lane, curvature[e / 9][e % 9]);
  }
}

double BlendedStars::derivatives(const double* q, double* gradient, double* hessian) {
  const double value = value_and_gradient(q, gradient);
  const auto d = static_cast<std::size_t>(dimension()), stride = form_.size() / (capacity() + 1);
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j < d; ++j) hessian[i * d + j] = 2.0 * form_[i * stride + j];
  add_block_hessians(rows_, half_runner_, second_half_, *this, hessian);
  return value;
}

void BlendedStars::curvatures(const double* q, float* hessians) {
  rows_.begin(q);
  rows_.store_curvatures(*this, hessians);
}

void BlendedStars::stresses(const double* q, float* stresses) {
  rows_.begin(q);
  rows_.store_stresses(*this, stresses);
}

}  // namespace snapspace::online
