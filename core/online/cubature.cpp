#include "online/cubature.h"

#include <algorithm>
#include <cmath>

#include "material/principal_hessian.h"
#include "simd/number_pairs.h"

namespace snapspace::online {

namespace {

template <int Width>
double lane_sum(const Lanes<Width>& pack) {
  double sum = 0.0;
  for (int lane = 0; lane < Width; ++lane) sum += pack[lane];
  return sum;
}

}  // namespace

Cubature::Cubature(int dimension, int tets, const float* rows, const double* weights,
                   const TetMaterial& material)
    : capacity_(dimension),
      dimension_(dimension),
      pairs_((dimension + 1) / 2),
      kind_(material.kind),
      tets_(tets),
      moduli_count_(material_moduli(material.kind)),
      coordinates_(2 * pairs_, 0.0),
      sums_(2 * pairs_) {
  const std::size_t size = static_cast<std::size_t>(tets) * 9 * dimension;
  double largest = 1e-200;
  for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, std::abs(double{rows[i]}));
  const double least = 1e-30 * largest;  // the first of two numbers must not be zero
  const auto word = [&](double first, double second) {
    return number_pair(std::abs(first) < least ? least : first, second);
  };

  words_.assign(static_cast<std::size_t>(blocks()) * pairs_ * 9, Tets(word(0.0, 0.0)));
  moduli_.assign(static_cast<std::size_t>(blocks()) * moduli_count_, Tets(0.0));
  for (int tet = 0; tet < tets; ++tet) {
    const int block = tet / kWidth, lane = tet % kWidth;
    for (int k = 0; k < moduli_count_; ++k)
      moduli_[block * moduli_count_ + k].set(lane, weights[tet] * material.of(tet)[k]);
    for (int pair = 0; pair < pairs_; ++pair)
      for (int e = 0; e < 9; ++e) {
        const float* row = rows + (static_cast<std::size_t>(tet) * 9 + e) * dimension + 2 * pair;
        const double second = 2 * pair + 1 < dimension ? row[1] : 0.0f;
        words_[(static_cast<std::size_t>(block) * pairs_ + pair) * 9 + e].set(lane,
                                                                              word(row[0], second));
      }
  }
}

void Cubature::set_dimension(int dimension) {
  dimension_ = dimension;
  pairs_ = (dimension + 1) / 2;
}

void Cubature::set_coordinates(const double* q) {
  std::copy_n(q, dimension_, coordinates_.data());
  if (dimension_ % 2 == 1) coordinates_[dimension_] = 0.0;
}

void Cubature::gradients(const Tets* words, Tets G[3][3]) const {
  // Nine named sums stay in registers, an array might not.
  Tets g0(0.0), g1(0.0), g2(0.0), g3(0.0), g4(0.0), g5(0.0), g6(0.0), g7(0.0), g8(0.0);
  for (int pair = 0; pair < pairs_; ++pair, words += 9) {
    const Tets a(coordinates_[2 * pair]), b(coordinates_[2 * pair + 1]);
    const auto term = [&](int e) { return words[e] * a + second_numbers(words[e]) * b; };
    g0 += term(0), g1 += term(1), g2 += term(2);
    g3 += term(3), g4 += term(4), g5 += term(5);
    g6 += term(6), g7 += term(7), g8 += term(8);
  }
  G[0][0] = g0, G[0][1] = g1, G[0][2] = g2;
  G[1][0] = g3, G[1][1] = g4, G[1][2] = g5;
  G[2][0] = g6, G[2][1] = g7, G[2][2] = g8;
}

/// For the coordinates that are set: the value, and in sums_ the gradient.
template <class Density>
double Cubature::add_values_and_stresses() {
  double value = 0.0;
  for (int b = 0; b < blocks(); ++b) {
    Tets G[3][3], P[3][3];
    const Tets* words = block(b);
    gradients(words, G);
    value += lane_sum(Density::value_and_stress(&moduli_[b * Density::kModuli], G, P));
    for (int pair = 0; pair < pairs_; ++pair, words += 9) {
      Tets first(0.0), second(0.0);
      for (int e = 0; e < 9; ++e) {
        first += words[e] * P[e / 3][e % 3];
        second += second_numbers(words[e]) * P[e / 3][e % 3];
      }
      sums_[2 * pair] += first;
      sums_[2 * pair + 1] += second;
    }
  }
  return value;
}

double Cubature::value_and_gradient(const double* q, double* gradient) {
  set_coordinates(q);
  std::fill(sums_.begin(), sums_.end(), Tets(0.0));
  const double value =
      Densities::with(kind_, [&]<class Density>() { return add_values_and_stresses<Density>(); });
  for (int mode = 0; mode < dimension_; ++mode) gradient[mode] = lane_sum(sums_[mode]);
  return value;
}

Cubature::Tets Cubature::entry(const Tets* words, int mode, int e) {
  const Tets word = words[9 * (mode / 2) + e];
  return mode % 2 == 0 ? word : second_numbers(word);
}

/// Hessians (9 x 9) of a block's tets by their displacement gradients, times weight.
void Cubature::curvatures(int block, const Tets G[3][3], Tets hessian[9][9]) const {
  for (int lane = 0; lane < kWidth && block * kWidth + lane < tets_; ++lane) {
    double moduli[kMostModuli], gradient[3][3], unit[3][3], column[3][3];
    for (int k = 0; k < moduli_count_; ++k) moduli[k] = moduli_[block * moduli_count_ + k][lane];
    for (int e = 0; e < 9; ++e) gradient[e / 3][e % 3] = G[e / 3][e % 3][lane];
    const PrincipalHessian tet({kind_, 1, moduli}, 0, gradient);
    for (int e = 0; e < 9; ++e) {
      for (int f = 0; f < 9; ++f) unit[f / 3][f % 3] = e == f ? 1.0 : 0.0;
      tet.multiply(unit, column);
      for (int f = 0; f < 9; ++f) hessian[f][e].set(lane, column[f / 3][f % 3]);
    }
  }
}

double Cubature::derivatives(const double* q, double* gradient, double* hessian) {
  const double value = value_and_gradient(q, gradient);
  const int d = dimension_;
  std::fill(hessian, hessian + static_cast<std::size_t>(d) * d, 0.0);
  for (int b = 0; b < blocks(); ++b) {
    Tets G[3][3], change[9], curvature[9][9];
    const Tets* words = block(b);
    gradients(words, G);
    for (auto& row : curvature)
      for (Tets& entry : row) entry = Tets(0.0);
    curvatures(b, G, curvature);
    for (int i = 0; i < d; ++i) {
      for (int f = 0; f < 9; ++f) {
        change[f] = Tets(0.0);
        for (int e = 0; e < 9; ++e) change[f] += curvature[f][e] * entry(words, i, e);
      }
      double* row = hessian + static_cast<std::size_t>(i) * d;
      for (int j = 0; j <= i; ++j) {
        Tets sum(0.0);
        for (int e = 0; e < 9; ++e) sum += entry(words, j, e) * change[e];
        row[j] += lane_sum(sum);
      }
    }
  }
  return value;
}

}  // namespace snapspace::online
