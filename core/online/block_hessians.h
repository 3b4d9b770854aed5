#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "online/half_runner.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// Adds the Hessian of the active blocks to the lower triangle of `hessian` (d x d), half of them
/// on each of two threads if there is a runner. Results are the same without it.
/// @param second      work array for the second half, at least d x d
/// @param curvatures  curvatures(block, C) sets the Hessians C of a block's elements by their
///                    displacement gradients; on both threads
template <class Curvatures>
void add_block_hessians(const TetRows& rows, HalfRunner* runner, std::vector<double>& second,
                        const Curvatures& curvatures, double* hessian) {
  const auto d = static_cast<std::size_t>(rows.dimension());
  std::fill_n(second.begin(), d * d, 0.0);
  run_halves(runner, [&](int half) {
    double* const sum = half == 0 ? hessian : second.data();
    for (const int b : rows.half(half)) {
      TetRows::Tets C[9][9];
      curvatures(b, C);
      rows.add_curvatures(b, C, sum);
    }
  });
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j <= i; ++j) hessian[i * d + j] += second[i * d + j];
}

/// Writes the Hessians of all elements by their displacement gradients, elements x 9 x 9.
/// @param curvatures  as above
template <class Curvatures>
void store_block_curvatures(const TetRows& rows, const Curvatures& curvatures, float* to) {
  for (int b = 0; b < rows.blocks(); ++b) {
    TetRows::Tets C[9][9];
    curvatures(b, C);
    for (int lane = 0; lane < rows.lanes(b); ++lane)
      for (int f = 0; f < 9; ++f)
        for (int e = 0; e < 9; ++e) *to++ = static_cast<float>(C[f][e][lane]);
  }
}

}  // namespace snapspace::online
