#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "online/half_runner.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// The energy of a sum's blocks, as TetRows::sum takes it.
template <class Sum>
auto energy_of(const Sum& sum) {
  return [&sum](int block, const TetRows::Tets G[3][3], TetRows::Tets P[3][3]) {
    return sum.block_energy(block, G, P);
  };
}

/// The curvatures of a sum's blocks, as TetRows::add_hessian takes them.
template <class Sum>
auto curvatures_of(const Sum& sum) {
  return [&sum](int block, const TetRows::Tets G[3][3], TetRows::Tets C[9][9]) {
    sum.block_curvatures(block, G, C);
  };
}

/// The energy of all active blocks at q (d); `gradient` (d) is overwritten. A large evaluation
/// takes two threads if there is a runner. Results are the same without it.
/// @param energy  see TetRows::sum; on both threads
template <class Energy>
double block_sum(TetRows& rows, HalfRunner* runner, const double* q, const Energy& energy,
                 double* gradient) {
  rows.begin(q);
  double values[2] = {0.0, 0.0};
  run_halves(rows.size() < kMinSharedSize ? nullptr : runner,
             [&](int half) { values[half] = rows.sum(half, energy); });
  rows.end(gradient);
  return values[0] + values[1];
}

/// Adds the Hessian of the active blocks to the lower triangle of `hessian` (d x d), half of them
/// on each of two threads if there is a runner. Results are the same without it.
/// @param second      work array for the second half, at least d x d
/// @param curvatures  see TetRows::add_hessian; on both threads
template <class Curvatures>
void add_block_hessians(TetRows& rows, HalfRunner* runner, std::vector<double>& second,
                        const Curvatures& curvatures, double* hessian) {
  const auto d = static_cast<std::size_t>(rows.dimension());
  std::fill_n(second.begin(), d * d, 0.0);
  run_halves(runner, [&](int half) {
    rows.add_hessian(half, curvatures, half == 0 ? hessian : second.data());
  });
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j <= i; ++j) hessian[i * d + j] += second[i * d + j];
}

/// Writes the Hessians of all elements by their displacement gradients, elements x 9 x 9.
/// @param curvatures  as above
template <class Curvatures>
void store_block_curvatures(TetRows& rows, const Curvatures& curvatures, float* to) {
  rows.for_each_block([&](int block, const TetRows::Tets G[3][3]) {
    TetRows::Tets C[9][9];
    curvatures(block, G, C);
    for (int lane = 0; lane < rows.lanes(block); ++lane)
      for (int f = 0; f < 9; ++f)
        for (int e = 0; e < 9; ++e) *to++ = static_cast<float>(C[f][e][lane]);
  });
}

/// Writes the stresses of all elements, elements x 9.
/// @param energy  see TetRows::sum
template <class Energy>
void store_block_stresses(TetRows& rows, const Energy& energy, float* to) {
  rows.for_each_block([&](int block, const TetRows::Tets G[3][3]) {
    TetRows::Tets P[3][3];
    (void)energy(block, G, P);
    for (int lane = 0; lane < rows.lanes(block); ++lane)
      for (int e = 0; e < 9; ++e) *to++ = static_cast<float>(P[e / 3][e % 3][lane]);
  });
}

}  // namespace snapspace::online
