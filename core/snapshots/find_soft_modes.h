#pragma once
#include "snapshots/posing_system.h"
#include "snapshots/soft_modes.h"

namespace snapspace {

/// The lowest modes of a posing problem's Hessian H at rest with respect to its scalar matrix A,
/// normalized to v . A v = 1, with the weights 1 / (kStiffening * (v . H v)).
/// A is an upper bound of H for local deformations, and far too stiff for the bending of long
/// parts: there H / A is a few thousandths, and a solve on the factor alone needs hundreds of
/// steps. The modes are found by LOBPCG (Knyazev 2001), preconditioned by the factor. They are the
/// same for any number of threads.
[[nodiscard]] SoftModes find_soft_modes(const PosingSystem& system);

}  // namespace snapspace
