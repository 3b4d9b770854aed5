#include "online/element_probe.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "element/make_rest_element.h"
#include "element/tet.h"
#include "material/shell_rest.h"
#include "online/reconstruct.h"
#include "online/tet_density.h"

namespace snapspace::online {

ElementProbe::ElementProbe(const ProbeBody& body, const ProbeSample& sample, const ProbePins& pins)
    : ResidualProbe(body.dimension, body.rests),
      corners_(body.corners),
      kind_(body.material.kind),
      moduli_per_tet_(body.material.rows == 1 ? 0 : material_moduli(kind_)),
      sampled_(sample.corners, sample.corners + sample.count),
      sample_weights_(sample.weights, sample.weights + sample.count),
      pins_(pins) {
  const std::size_t size = 3 * static_cast<std::size_t>(corners_);
  tau_.assign(body.tau, body.tau + size);
  modes_.assign(body.modes, body.modes + dimension() * size);
  rest_shapes_.assign(body.rest_shapes, body.rest_shapes + rests() * size);
  const std::size_t moduli = static_cast<std::size_t>(body.material.rows) * material_moduli(kind_);
  for (int k = 0; k < (is_of_shells(kind_) ? rests() : 1); ++k)
    moduli_.insert(moduli_.end(), body.material.moduli, body.material.moduli + moduli);
  tets_.reserve(static_cast<std::size_t>(rests()) * body.tets);
  for (int k = 0; k < rests(); ++k)
    for (int t = 0; t < body.tets; ++t)
      tets_.push_back(make_rest_element(is_of_shells(kind_), rest_shapes_.data() + k * size,
                                        body.tet_corners + 4 * t));
  if (is_of_shells(kind_) && rests() > 1) set_rest_numbers(body.tet_corners);
  for (auto* numbers : {&shape_, &displacement_, &gradient_}) numbers->resize(size);
}

/// The material has the numbers of the rest shape in one pose.
void ElementProbe::set_rest_numbers(const std::int32_t* corners) {
  const std::size_t tets = tets_.size() / rests(), size = 3 * static_cast<std::size_t>(corners_);
  const int width = material_moduli(kind_);
  for (std::size_t t = 0; t < tets; ++t) {
    const double length = 1.0 / tets_[t].inverse_edges[0][0];
    const double product = moduli_[(t + 1) * width - 2] * length * length * length * length;
    for (int k = 0; k < rests(); ++k)
      set_rest_shape(kind_, rest_shapes_.data() + k * size, corners + 4 * t, product,
                     moduli_.data() + (k * tets + t) * width);
  }
}

double ElementProbe::norm(const double* q, int dimension, const double* offsets,
                          const double* weights) {
  reconstruct(shape_.size(), dimension, tau_.data(), modes_.data(), q, shape_.data());
  std::fill(gradient_.begin(), gradient_.end(), 0.0);
  const std::size_t tets = tets_.size() / rests();
  const std::size_t moduli = is_of_shells(kind_) ? tets * material_moduli(kind_) : 0;
  for (int k = 0; k < rests(); ++k) {
    if (weights && weights[k] == 0.0) continue;
    add_elastic(rest_shapes_.data() + k * shape_.size(), tets_.data() + k * tets,
                moduli_.data() + k * moduli, weights ? weights[k] : 1.0);
  }
  if (offsets) {
    // displacement_ is from the only rest shape here, because poses are not pinned
    pins_.add_pulls(displacement_.data(), gradient_.data());
    pins_.subtract_wanted(offsets, gradient_.data());
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < sampled_.size(); ++i) {
    const double* g = gradient_.data() + 3 * static_cast<std::size_t>(sampled_[i]);
    sum += sample_weights_[i] * (g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  }
  return std::sqrt(sum);
}

void ElementProbe::add_elastic(const double* rest_shape, const RestTet* tets, const double* moduli,
                               double weight) {
  for (std::size_t i = 0; i < shape_.size(); ++i) displacement_[i] = shape_[i] - rest_shape[i];
  const int count = static_cast<int>(tets_.size()) / rests();
  using Tets = TetRows::Tets;
  for (int begin = 0; begin < count; begin += TetRows::kWidth) {
    const int lanes = std::min(TetRows::kWidth, count - begin);
    Tets numbers[kMaxModuli], G[3][3], P[3][3];
    std::fill_n(numbers, kMaxModuli, Tets(0.0));
    for (auto& row : G) std::fill_n(row, 3, Tets(0.0));
    for (int lane = 0; lane < lanes; ++lane, moduli += moduli_per_tet_) {
      const RestTet& tet = tets[begin + lane];
      double weighted[kMaxModuli], own[3][3];
      scale_moduli(kind_, moduli, weight * tet.volume, weighted);
      for (int i = 0; i < material_moduli(kind_); ++i) numbers[i].set(lane, weighted[i]);
      displacement_gradient(tet, displacement_.data(), own);
      for (int e = 0; e < 9; ++e) G[e / 3][e % 3].set(lane, own[e / 3][e % 3]);
    }
    (void)value_and_stress(kind_, numbers, G, P);
    for (int lane = 0; lane < lanes; ++lane) {
      double stress[3][3];
      for (int e = 0; e < 9; ++e) stress[e / 3][e % 3] = P[e / 3][e % 3][lane];
      scatter_stress(tets[begin + lane], stress, gradient_.data());
    }
  }
}

}  // namespace snapspace::online
