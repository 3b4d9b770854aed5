#pragma once
#include "material/bending.h"
#include "material/hessian_of.h"
#include "material/hinge_energy.h"
#include "material/lame.h"
#include "material/membrane.h"
#include "material/shell_blend.h"
#include "material/triangle.h"

namespace snapspace {

/// The energy of a thin shell: a membrane in its triangles, and bending at its hinges [Grinspun,
/// Hirani, Desbrun, Schroeder 2003]. An element is a triangle or a hinge, see element/rest_shell.h.
///
/// Other densities do not depend on the rest shape. This one has numbers of the element's rest
/// shape after its moduli:
///   triangle  mu, lam, 0, and the 3 x 2 tangent frame T of the rest triangle, row by row. F = T +
///   G
///             with the first two columns of G; the moduli are those of the plane, times thickness
///   hinge     0, 0, bending, the measure at rest (see bending.h), the 3 x 3 matrix of the rest
///             edges, row by row, four times the product of both areas, and a factor of bending.
///             The edges are that matrix + G, in units of the rest edge; psi = factor * bending/2
///             (strain / cosh(rho))^2 with rho of HingeAreas, see HingeForm. The factor is one over
///             the square of the measure's slope at rest: with it the energy of small strains is
///             the same for all rest angles
template <class Membrane, class Bending>
struct ShellDensity {
  static constexpr int kModuli = 15;
  static constexpr int kScaled = 3;  ///< the moduli: energies
  using Blend = ShellBlend<Membrane, Bending>;
  static constexpr const char* kModulusNames[kModuli] = {
      "mu",     "lam",    "bending", "rest_0", "rest_1", "rest_2",  "rest_3", "rest_4",
      "rest_5", "rest_6", "rest_7",  "rest_8", "rest_9", "rest_10", "rest_11"};

  /// A triangle has those of plane stress, a hinge the stiffness `bending`.
  static Lame small_strains(const double* numbers) {
    return {numbers[1], is_triangle(numbers) ? numbers[0] : 0.5 * numbers[2]};
  }
  static bool is_triangle(const double* numbers) { return numbers[0] > 0.0; }

  template <class Real>
  static Real value_and_stress(const Real* numbers, const Real G[3][3], Real P[3][3]) {
    const Real zero(0.0);
    if (!any_negative(zero - numbers[2])) return triangle(numbers, G, P);
    if (!any_negative(zero - numbers[0])) return hinge(numbers, G, P);
    // The last triangles and the first hinges share a pack.
    const Real mask = is_less(zero, numbers[0]);
    Real bent[3][3];
    const Real value = triangle(numbers, G, P), bending = hinge(numbers, G, bent);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) P[r][c] = select(mask, P[r][c], bent[r][c]);
    return select(mask, value, bending);
  }

  /// Sets those numbers of a hinge that depend on its rest angle, from the tangent of half the
  /// angle.
  static void set_rest_angle(double tangent, double* numbers) {
    const Bend<double> rest = Bending::of(tangent);
    numbers[kScaled] = rest.measure;
    numbers[kModuli - 1] = 1.0 / (rest.slope * rest.slope);
  }

  /// The change dP of the stress at rest for a small G.
  template <class Real>
  static void rest_differential(const double* numbers, const Real G[3][3], Real P[3][3]) {
    using T = typename ScalarOf<Real>::type;
    if (is_triangle(numbers)) {
      const Real lam(static_cast<T>(numbers[1])), mu(static_cast<T>(numbers[0]));
      Real F[3][2], E2[3], S[3];
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 2; ++c) F[r][c] = Real(static_cast<T>(numbers[3 + 2 * r + c]));
      symmetric_product(F, G, E2);
      PlaneStVK::value_and_stress(lam, mu, E2, S);
      plane_stress(F, S, P);
      return;
    }
    double E[3][3];
    for (int e = 0; e < 9; ++e) E[e / 3][e % 3] = numbers[4 + e];
    const HingeAngle<double> angle(E);
    Real change(0.0);
    for (int r = 0; r < 3; ++r)
      change += Real(static_cast<T>(angle.by_e[r])) * G[r][0] +
                Real(static_cast<T>(angle.by_a[r])) * G[r][1] +
                Real(static_cast<T>(angle.by_b[r])) * G[r][2];
    change = Real(static_cast<T>(numbers[2])) * change;
    for (int r = 0; r < 3; ++r) {
      P[r][0] = Real(static_cast<T>(angle.by_e[r])) * change;
      P[r][1] = Real(static_cast<T>(angle.by_a[r])) * change;
      P[r][2] = Real(static_cast<T>(angle.by_b[r])) * change;
    }
  }

  /// The Hessian (9 x 9) with respect to G.
  static void hessian(const double* numbers, const double G[3][3], double H[9][9]) {
    if (!is_triangle(numbers)) {
      const HingeState<Bending, double> state = hinge_state(numbers, G);
      return hessian_of([&](const auto& dG, auto& dP) { state.differential(dG, dP); }, H);
    }
    const TriangleStrain<double> strain(numbers + kScaled, G);
    const double lam = numbers[1], mu = numbers[0];
    double S[3];
    Membrane::value_and_stress(lam, mu, strain.E2, S);
    const auto differential = [&](const double* dE2, double* dS) {
      Membrane::differential(lam, mu, strain.E2, dE2, dS);
    };
    hessian_of([&](const auto& dG, auto& dP) { strain.stress_change(S, dG, differential, dP); }, H);
  }

 private:
  template <class Real>
  static Real triangle(const Real* numbers, const Real G[3][3], Real P[3][3]) {
    const TriangleStrain<Real> strain(numbers + kScaled, G);
    Real S[3];
    const Real value = Membrane::value_and_stress(numbers[1], numbers[0], strain.E2, S);
    plane_stress(strain.F, S, P);
    return value;
  }

  template <class Real>
  static Real hinge(const Real* numbers, const Real G[3][3], Real P[3][3]) {
    return hinge_state(numbers, G).value_and_stress(P);
  }

  template <class Real>
  static HingeState<Bending, Real> hinge_state(const Real* numbers, const Real G[3][3]) {
    return {numbers + kScaled, G, {numbers[2] * numbers[kModuli - 1], Real(0.0), Real(0.0)}};
  }
};

struct ShellNeoHookean : ShellDensity<PlaneNeoHookean, AngleBend> {
  static constexpr const char* kName = "shell-stable-neo-hookean";
};
struct ShellStVK : ShellDensity<PlaneStVK, AngleBend> {
  static constexpr const char* kName = "shell-stvk";
};
struct ShellNeoHookeanTangent : ShellDensity<PlaneNeoHookean, TangentBend> {
  static constexpr const char* kName = "shell-stable-neo-hookean-tangent";
};
struct ShellStVKTangent : ShellDensity<PlaneStVK, TangentBend> {
  static constexpr const char* kName = "shell-stvk-tangent";
};

}  // namespace snapspace
