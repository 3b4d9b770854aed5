#pragma once
#include <vector>

#include "snapshots/posing_system.h"

namespace snapspace {

/// Times in seconds of the two large parts of an L-BFGS step on one thread for a pack of samples,
/// and their floating-point operations.
struct PartTimes {
  double kernel_seconds = 0.0;  ///< objective and gradient
  double solve_seconds = 0.0;   ///< both triangular solves, or a multigrid cycle
  double kernel_flops = 0.0;
  double solve_flops = 0.0;
};

/// Measures the parts with the widest pack.
/// @param shape  3n displacements in the system's numbering, in all lanes
[[nodiscard]] PartTimes time_parts(const PosingSystem& system, const std::vector<double>& shape,
                                   bool single, int repeats);

}  // namespace snapspace
