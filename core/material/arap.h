#pragma once
#include <algorithm>

#include "material/lame.h"
#include "material/principal_curvature.h"
#include "material/rotation.h"

namespace snapspace {

/// As-rigid-as-possible: psi = mu |F - R|^2, with the rotation R nearest to F [Chao, Pinkall,
/// Sanan, Schroeder 2010].
struct Arap {
  static constexpr const char* kName = "arap";
  static constexpr int kModuli = 1;
  static constexpr const char* kModulusNames[kModuli] = {"mu"};

  static Lame small_strains(const double* moduli) { return {0.0, moduli[0]}; }

  template <class Real>
  static Real value_and_stress(const Real* moduli, const Real G[3][3], Real P[3][3]) {
    const Real mu = moduli[0], twice = mu + mu;
    const RotationDistance<Real> distance(G);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) P[r][c] = twice * distance.difference[r][c];
    return mu * distance.square;
  }

  static PrincipalCurvature curvature(const double* moduli, const double s[3]) {
    const double twice = 2.0 * moduli[0];
    PrincipalCurvature result = {};
    for (int i = 0; i < 3; ++i) {
      result.scaling[i][i] = result.flip[i] = twice;
      // The rotation jumps where two singular values cancel; near there the curvature is kept
      // finite.
      const double sum = std::max(s[kPairs[i][0]] + s[kPairs[i][1]], kMinSum);
      result.twist[i] = twice - 2.0 * twice / sum;
    }
    return result;
  }

 private:
  static constexpr double kMinSum = 1e-3;
};

}  // namespace snapspace
