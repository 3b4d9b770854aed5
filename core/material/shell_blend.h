#pragma once
#include "material/hessian_of.h"
#include "material/hinge_energy.h"
#include "material/triangle.h"
#include "simd/functions.h"

namespace snapspace {

/// sum_k w_k psi_k of a triangle or a hinge in several poses, collapsed: the cost does not depend
/// on the number of poses. G is relative to pose 0.
///
/// A triangle has F_k = F_0 A_k, with the constant map A_k (2 x 2) between the tangent frames, and
/// its membrane collapses as `Membrane::Blend` says. A hinge has a quadratic polynomial of the
/// strain relative to pose 0, see HingeForm: all poses share the product of areas that lets bending
/// vanish.
/// The numbers that follow these sums are the same for all poses: whether the element is a
/// triangle, whether it is a hinge, and the numbers of the rest shape in pose 0.
template <class Membrane, class Bending>
struct ShellBlend {
  using Sheet = typename Membrane::Blend;
  static constexpr int kSums = Sheet::kNumbers;
  static constexpr int kRest = 12;  ///< numbers of a rest shape, see ShellDensity
  static constexpr int kConstants = 2 + kRest;
  static constexpr int kNumbers = kSums + kConstants;
  static_assert(kSums >= 3, "space for a HingeForm");

  /// @param numbers  of the density in the pose, with moduli times the element's measure there
  /// @param first    those in pose 0
  /// @param G        displacement gradient of pose 0 relative to the pose
  static void fill(const double* numbers, const double* first, const double G[3][3],
                   double* result) {
    const bool triangle = numbers[0] > 0.0;
    for (int i = 0; i < kSums; ++i) result[i] = 0.0;
    if (triangle) {
      double A[2][2] = {};  // T_0^T (T + G)
      for (int r = 0; r < 3; ++r)
        for (int i = 0; i < 2; ++i)
          for (int j = 0; j < 2; ++j)
            A[i][j] += first[3 + 2 * r + i] * (numbers[3 + 2 * r + j] + G[r][j]);
      Sheet::fill(numbers[1], numbers[0], A, result);
    } else {
      const double strain = numbers[3] - reference(first);
      result[0] = numbers[2] * numbers[kRest + 2];
      result[1] = result[0] * strain;
      result[2] = result[1] * strain;
    }
    result[kSums] = triangle ? 1.0 : 0.0;
    result[kSums + 1] = triangle ? 0.0 : 1.0;
    for (int i = 0; i < kRest; ++i) result[kSums + 2 + i] = first[3 + i];
    if (!triangle) result[kSums + 2] = reference(first);
  }

  template <class Real>
  static Real value_and_stress(const Real* numbers, const Real G[3][3], Real P[3][3]) {
    const Real zero(0.0);
    if (!any_negative(zero - numbers[kSums + 1])) return triangle(numbers, G, P);
    if (!any_negative(zero - numbers[kSums])) return hinge(numbers, G).value_and_stress(P);
    // The last triangles and the first hinges share a pack.
    const Real mask = is_less(zero, numbers[kSums]);
    Real bent[3][3];
    const Real value = triangle(numbers, G, P);
    const Real bending = hinge(numbers, G).value_and_stress(bent);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) P[r][c] = select(mask, P[r][c], bent[r][c]);
    return select(mask, value, bending);
  }

  /// The Hessian (9 x 9) with respect to G.
  static void hessian(const double* numbers, const double G[3][3], double H[9][9]) {
    if (!(numbers[kSums] > 0.0)) {
      const HingeState<Bending, double> state = hinge(numbers, G);
      return hessian_of([&](const auto& dG, auto& dP) { state.differential(dG, dP); }, H);
    }
    const TriangleStrain<double> strain(numbers + kSums + 2, G);
    double S[3];
    Sheet::value_and_stress(numbers, strain.E2, S);
    const auto differential = [&](const double* dE2, double* dS) {
      Sheet::differential(numbers, strain.E2, dE2, dS);
    };
    hessian_of([&](const auto& dG, auto& dP) { strain.stress_change(S, dG, differential, dP); }, H);
  }

 private:
  /// The measure relative to which strains are taken. With that of pose 0 itself, the others would
  /// lose digits if the hinge is folded there.
  static double reference(const double* first) {
    constexpr double kMost = 3.0;
    return first[3] < -kMost ? -kMost : first[3] > kMost ? kMost : first[3];
  }

  template <class Real>
  static Real triangle(const Real* numbers, const Real G[3][3], Real P[3][3]) {
    const TriangleStrain<Real> strain(numbers + kSums + 2, G);
    Real S[3];
    const Real value = Sheet::value_and_stress(numbers, strain.E2, S);
    plane_stress(strain.F, S, P);
    return value;
  }

  template <class Real>
  static HingeState<Bending, Real> hinge(const Real* numbers, const Real G[3][3]) {
    return {numbers + kSums + 2, G, {numbers[0], numbers[1], numbers[2]}};
  }
};

}  // namespace snapspace
