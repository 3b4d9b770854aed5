#pragma once
#include <cstddef>

namespace snapspace::live {

/// shape = tau + sum_i q_i mode_i; see online::reconstruct.
void reconstruct(std::size_t size, int dimension, const double* tau, const double* modes,
                 const double* q, double* shape);

}  // namespace snapspace::live
