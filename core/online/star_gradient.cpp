#include "online/star_gradient.h"

#include <algorithm>

#include "element/tet.h"
#include "material/shell_arap.h"
#include "online/tet_density.h"

namespace snapspace::online {

namespace {

/// A triangle's frame T and displacement gradient G: F = T + G. Their third columns are zero.
struct Deformed {
  double T[3][3], G[3][3];

  [[gnu::noinline]] Deformed(const RestTet& triangle, const double* numbers,
                             const double* displacement) {
    ShellArap::frame(numbers, T);
    displacement_gradient(triangle, displacement, G);
  }
};

}  // namespace

void StarGradient::add(const RestTet* triangles, int count, const double* numbers,
                       const double* displacement, double weight, double* gradient) {
  std::fill(means_.begin(), means_.end(), Mean{});
  for (int t = 0; t < count; ++t) {
    const double* row = numbers + static_cast<std::size_t>(t) * ShellArap::kModuli;
    const Deformed at(triangles[t], row, displacement);
    double F[3][3], S[3][3];
    const double share = row[0] * triangles[t].volume;
    for (int e = 0; e < 9; ++e) F[e / 3][e % 3] = share * (at.T[e / 3][e % 3] + at.G[e / 3][e % 3]);
    multiply_transposed(F, at.T, S);
    for (int k = 0; k < 3; ++k) {
      Mean& mean = means_[triangles[t].vertices[k]];
      for (int e = 0; e < 9; ++e) mean.S[e / 3][e % 3] += S[e / 3][e % 3];
      mean.weight += share;
    }
  }
  find_turns();
  for (int t = 0; t < count; ++t) {
    const double* row = numbers + static_cast<std::size_t>(t) * ShellArap::kModuli;
    const Deformed at(triangles[t], row, displacement);
    const double share = 2.0 / 3.0 * weight * row[0] * triangles[t].volume;
    double W[3][3] = {}, P[3][3];
    for (int k = 0; k < 3; ++k) {
      const Turn& turn = turns_[triangles[t].vertices[k]];
      for (int e = 0; e < 9; ++e) W[e / 3][e % 3] += turn.W[e / 3][e % 3];
    }
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        P[r][c] = share * (3.0 * at.G[r][c] - W[r][0] * at.T[0][c] - W[r][1] * at.T[1][c] -
                           W[r][2] * at.T[2][c]);
    scatter_stress(triangles[t], P, gradient);
  }
}

/// The stress S - R is that of ShellArap with the frame I and half a modulus, for a pack of
/// vertices: its code is there already.
void StarGradient::find_turns() {
  using Vertices = TetRows::Tets;
  constexpr double kRow[ShellArap::kModuli] = {0.5, 0.0, 0.0, 1.0, 0.0, 0.0,
                                               1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  Vertices numbers[ShellArap::kModuli];
  std::copy_n(kRow, ShellArap::kModuli, numbers);
  const int count = static_cast<int>(means_.size());
  for (int begin = 0; begin < count; begin += TetRows::kWidth) {
    const int lanes = std::min(TetRows::kWidth, count - begin);
    Vertices change[3][3], P[3][3];
    for (int e = 0; e < 9; ++e) {
      change[e / 3][e % 3] = Vertices(0.0);
      for (int lane = 0; lane < lanes; ++lane) {
        const Mean& mean = means_[begin + lane];
        change[e / 3][e % 3].set(lane,
                                 mean.S[e / 3][e % 3] / mean.weight - (e % 4 == 0 ? 1.0 : 0.0));
      }
    }
    (void)value_and_stress(kind_, numbers, change, P);
    for (int lane = 0; lane < lanes; ++lane)
      for (int e = 0; e < 9; ++e)
        turns_[begin + lane].W[e / 3][e % 3] = change[e / 3][e % 3][lane] - P[e / 3][e % 3][lane];
  }
}

}  // namespace snapspace::online
