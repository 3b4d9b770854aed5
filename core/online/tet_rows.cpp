#include "online/tet_rows.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace snapspace::online {

TetRows::TetRows(int dimension, int tets, const float* rows)
    : capacity_(dimension),
      dimension_(dimension),
      pairs_((dimension + 1) / 2),
      tets_(tets),
      active_(blocks()),
      coordinates_(2 * pairs_, 0.0),
      sums_(4 * pairs_) {
  std::iota(active_.begin(), active_.end(), 0);
  const std::size_t size = static_cast<std::size_t>(tets) * 9 * dimension;
  double largest = 1e-200;
  for (std::size_t i = 0; i < size; ++i) largest = std::max(largest, std::abs(double{rows[i]}));
  const double smallest = 1e-30 * largest;  // the first of two numbers must not be zero
  const auto word = [&](double first, double second) {
    return number_pair(std::abs(first) < smallest ? smallest : first, second);
  };

  words_.assign(static_cast<std::size_t>(blocks()) * pairs_ * 9, Tets(word(0.0, 0.0)));
  for (int tet = 0; tet < tets; ++tet) {
    const int block = tet / kWidth, lane = tet % kWidth;
    for (int pair = 0; pair < pairs_; ++pair)
      for (int e = 0; e < 9; ++e) {
        const float* row = rows + (static_cast<std::size_t>(tet) * 9 + e) * dimension + 2 * pair;
        const double second = 2 * pair + 1 < dimension ? row[1] : 0.0f;
        words_[(static_cast<std::size_t>(block) * pairs_ + pair) * 9 + e].set(lane,
                                                                              word(row[0], second));
      }
  }
}

void TetRows::set_dimension(int dimension) {
  dimension_ = dimension;
  pairs_ = (dimension + 1) / 2;
}

void TetRows::begin(const double* q) {
  std::copy_n(q, dimension_, coordinates_.data());
  if (dimension_ % 2 == 1) coordinates_[dimension_] = 0.0;
  std::fill(sums_.begin(), sums_.end(), Tets(0.0));
}

void TetRows::gradients(int block, Tets G[3][3]) const {
  // Nine named sums stay in registers; an array might not.
  Tets g0(0.0), g1(0.0), g2(0.0), g3(0.0), g4(0.0), g5(0.0), g6(0.0), g7(0.0), g8(0.0);
  const Tets* row = words(block);
  for (int pair = 0; pair < pairs_; ++pair, row += 9) {
    const Tets a(coordinates_[2 * pair]), b(coordinates_[2 * pair + 1]);
    const auto term = [&](int e) { return row[e] * a + second_numbers(row[e]) * b; };
    g0 += term(0), g1 += term(1), g2 += term(2);
    g3 += term(3), g4 += term(4), g5 += term(5);
    g6 += term(6), g7 += term(7), g8 += term(8);
  }
  G[0][0] = g0, G[0][1] = g1, G[0][2] = g2;
  G[1][0] = g3, G[1][1] = g4, G[1][2] = g5;
  G[2][0] = g6, G[2][1] = g7, G[2][2] = g8;
}

void TetRows::add_stresses(int half, int block, const Tets P[3][3]) {
  // Copies stay in registers, because writes to the sums cannot change them.
  const Tets p0 = P[0][0], p1 = P[0][1], p2 = P[0][2], p3 = P[1][0], p4 = P[1][1], p5 = P[1][2],
             p6 = P[2][0], p7 = P[2][1], p8 = P[2][2];
  // Three sums of three terms: one sum of nine would wait for each addition.
  const auto force = [&](const auto& entry) {
    Tets x = entry(0) * p0, y = entry(1) * p1, z = entry(2) * p2;
    x += entry(3) * p3, y += entry(4) * p4, z += entry(5) * p5;
    x += entry(6) * p6, y += entry(7) * p7, z += entry(8) * p8;
    return x + (y + z);
  };
  const Tets* row = words(block);
  Tets* sum = sums_.data() + static_cast<std::size_t>(half) * 2 * pairs_;
  for (int pair = 0; pair < pairs_; ++pair, row += 9, sum += 2) {
    sum[0] += force([row](int e) { return row[e]; });
    sum[1] += force([row](int e) { return second_numbers(row[e]); });
  }
}

void TetRows::end(double* gradient) const {
  for (int mode = 0; mode < dimension_; ++mode)
    gradient[mode] = lane_sum(sums_[mode] + sums_[2 * pairs_ + mode]);
}

void TetRows::add_curvatures(int block, const Tets curvature[9][9], double* hessian) const {
  // Modes lie in pairs: a word that is read serves four sums.
  const Tets* const own = words(block);
  for (int pair = 0; pair < pairs_; ++pair) {
    Tets change[2][9];
    for (int f = 0; f < 9; ++f) {
      change[0][f] = change[1][f] = Tets(0.0);
      for (int e = 0; e < 9; ++e) {
        change[0][f] += curvature[f][e] * own[9 * pair + e];
        change[1][f] += curvature[f][e] * second_numbers(own[9 * pair + e]);
      }
    }
    for (int other = 0; other <= pair; ++other) {
      Tets sums[2][2] = {{Tets(0.0), Tets(0.0)}, {Tets(0.0), Tets(0.0)}};
      for (int e = 0; e < 9; ++e) {
        const Tets first = own[9 * other + e], second = second_numbers(first);
        for (int i = 0; i < 2; ++i) {
          sums[i][0] += change[i][e] * first;
          sums[i][1] += change[i][e] * second;
        }
      }
      for (int i = 0; i < 2 && 2 * pair + i < dimension_; ++i) {
        double* const row = hessian + static_cast<std::size_t>(2 * pair + i) * dimension_;
        for (int j = 0; j < 2 && 2 * other + j <= 2 * pair + i; ++j)
          row[2 * other + j] += lane_sum(sums[i][j]);
      }
    }
  }
}

}  // namespace snapspace::online
