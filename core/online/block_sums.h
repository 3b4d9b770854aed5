#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "online/half_runner.h"
#include "online/tet_rows.h"

namespace snapspace::online {

/// The energy of all active blocks at q (d); `gradient` (d) is overwritten. A large evaluation
/// takes two threads if there is a runner. Results are the same without it.
inline double block_sum(TetRows& rows, HalfRunner* runner, const double* q,
                        const TetEnergies& energies, double* gradient) {
  rows.begin(q);
  double values[2] = {0.0, 0.0};
  run_halves(runner, rows.size(), [&](int half) { values[half] = rows.sum(half, energies); });
  rows.end(gradient);
  return values[0] + values[1];
}

/// Adds the Hessian of the active blocks to the lower triangle of `hessian` (d x d), half of them
/// on each of two threads if there is a runner. Results are the same without it.
/// @param second  work array for the second half, at least d x d
inline void add_block_hessians(TetRows& rows, HalfRunner* runner, std::vector<double>& second,
                               const TetEnergies& energies, double* hessian) {
  const auto d = static_cast<std::size_t>(rows.dimension());
  std::fill_n(second.begin(), d * d, 0.0);
  run_halves(runner, [&](int half) {
    rows.add_hessian(half, energies, half == 0 ? hessian : second.data());
  });
  for (std::size_t i = 0; i < d; ++i)
    for (std::size_t j = 0; j <= i; ++j) hessian[i * d + j] += second[i * d + j];
}

}  // namespace snapspace::online
