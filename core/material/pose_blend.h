#pragma once
#include "material/materials.h"
#include "simd/lanes.h"

namespace snapspace {

/// sum_k w_k psi_k(F A_k) of a tet: the weighted sum of its energies relative to several poses of
/// one body. F is the deformation gradient relative to pose 0, and the constant A_k maps the tet's
/// edges in pose k onto those in pose 0. Each pose contributes some numbers to a tet. Most
/// densities need the numbers of every pose: the map A_k - I, and the moduli times the tet's volume
/// in pose k. A density with a nested `Blend` collapses: its numbers are summed over the poses,
/// times the weights, and evaluating the sum costs the same for any number of poses. The elements
/// of a shell collapse too, see ShellBlend.
template <class Density>
struct PoseBlend {
  static constexpr bool kCollapses = requires { typename Density::Blend; };

  /// How many numbers a pose contributes to a tet.
  static constexpr int numbers() {
    if constexpr (kCollapses)
      return Density::Blend::kNumbers;
    else
      return 9 + Density::kModuli;
  }

  /// How many of a pose's last numbers are the same for all poses; these are not summed.
  static constexpr int constants() {
    if constexpr (kOfHinges<Density>)
      return Density::Blend::kConstants;
    else
      return 0;
  }

  /// @param moduli  times the tet's volume in the pose   @param map  A - I
  /// @param first   the moduli in pose 0, which shells need
  static void fill(const double* moduli, [[maybe_unused]] const double* first,
                   const double map[3][3], double* result) {
    if constexpr (kOfHinges<Density>) {
      Density::Blend::fill(moduli, first, map, result);
    } else if constexpr (kCollapses) {
      Density::Blend::fill(moduli, map, result);
    } else {
      for (int e = 0; e < 9; ++e) result[e] = map[e / 3][e % 3];
      for (int i = 0; i < Density::kModuli; ++i) result[9 + i] = moduli[i];
    }
  }
};

/// The sum over poses of a density that does not collapse, and P = sum_k w_k P_k A_k^T, at the
/// displacement gradient G relative to pose 0.
/// @param numbers  pose by pose, see PoseBlend: numbers, or packs with one tet per lane
/// @param density  (moduli, G, P) -> value of the density, with its stress in P
template <class Number, class Real, class Density>
inline Sum<Real> sum_over_poses(int poses, int moduli_count, const Real* weights,
                                const Number* numbers, const Real G[3][3], Real P[3][3],
                                Density density) {
  Sum<Real> value(0.0);
  for (int e = 0; e < 9; ++e) P[e / 3][e % 3] = Real(0.0);
  for (int k = 0; k < poses; ++k, numbers += 9 + moduli_count) {
    Real map[3][3], pose_G[3][3], stress[3][3], moduli[kMaxModuli];
    for (int e = 0; e < 9; ++e) map[e / 3][e % 3] = Real(numbers[e]);
    for (int i = 0; i < moduli_count; ++i) moduli[i] = weights[k] * Real(numbers[9 + i]);
    // F A - I = map + G + G map
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        pose_G[r][c] =
            map[r][c] + G[r][c] + (G[r][0] * map[0][c] + G[r][1] * map[1][c] + G[r][2] * map[2][c]);
    value += widened(density(moduli, pose_G, stress));
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        P[r][c] += stress[r][c] +
                   (stress[r][0] * map[c][0] + stress[r][1] * map[c][1] + stress[r][2] * map[c][2]);
  }
  return value;
}

}  // namespace snapspace
