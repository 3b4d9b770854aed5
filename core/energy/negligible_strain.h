#pragma once

namespace snapspace {

/// Energies of a body with this strain everywhere count as zero.
constexpr double kNegligibleStrain = 1e-12;

}  // namespace snapspace
