#pragma once
#include "material/bending.h"
#include "material/hinge.h"
#include "material/lame.h"
#include "material/membrane.h"

namespace snapspace {

/// The energy of a thin shell: a membrane in its triangles, and bending at its hinges [Grinspun,
/// Hirani, Desbrun, Schroeder 2003]. An element is a triangle or a hinge, see element/rest_shell.h.
///
/// Other densities know no rest shape. This one has numbers of the element's rest shape after its
/// moduli:
///   triangle  mu, lam, 0, and the 3 x 2 tangent frame T of the rest triangle, row by row. F = T +
///   G
///             with the first two columns of G; the moduli are those of the plane, times thickness
///   hinge     0, 0, bending, the tangent of half the rest angle, and the 3 x 3 matrix of the rest
///             edges, row by row, and four times the product of both areas. The edges are that
///             matrix + G, in units of the rest edge; psi = bending/2 (strain / cosh(rho))^2 with
///             the strain of `Bending` and rho of HingeAreas
template <class Membrane, class Bending>
struct ShellDensity {
  static constexpr int kModuli = 14;
  static constexpr int kScaled = 3;  ///< the moduli: energies
  static constexpr const char* kModulusNames[kModuli] = {
      "mu",     "lam",    "bending", "rest_0", "rest_1", "rest_2", "rest_3",
      "rest_4", "rest_5", "rest_6",  "rest_7", "rest_8", "rest_9", "rest_10"};

  /// Of a triangle those of the plane; a hinge has the stiffness `bending`.
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
      stress(F, S, P);
      return;
    }
    double E[3][3];
    for (int e = 0; e < 9; ++e) E[e / 3][e % 3] = numbers[4 + e];
    const HingeAngle<double> angle(E);
    const double slope = Bending::of(angle.sine, angle.cosine, angle.length, numbers[3]).slope;
    Real change(0.0);
    for (int r = 0; r < 3; ++r)
      change += Real(static_cast<T>(angle.by_e[r])) * G[r][0] +
                Real(static_cast<T>(angle.by_a[r])) * G[r][1] +
                Real(static_cast<T>(angle.by_b[r])) * G[r][2];
    change = Real(static_cast<T>(numbers[2] * slope * slope)) * change;
    for (int r = 0; r < 3; ++r) {
      P[r][0] = Real(static_cast<T>(angle.by_e[r])) * change;
      P[r][1] = Real(static_cast<T>(angle.by_a[r])) * change;
      P[r][2] = Real(static_cast<T>(angle.by_b[r])) * change;
    }
  }

  /// The Hessian (9 x 9) by the entries of G.
  static void hessian(const double* numbers, const double G[3][3], double H[9][9]) {
    for (int e = 0; e < 9; ++e) {
      double dG[3][3] = {}, dP[3][3] = {};
      dG[e / 3][e % 3] = 1.0;
      if (is_triangle(numbers)) {
        if (e % 3 < 2) triangle_differential(numbers, G, dG, dP);
      } else {
        hinge_differential(numbers, G, dG, dP);
      }
      for (int f = 0; f < 9; ++f) H[f][e] = dP[f / 3][f % 3];
    }
  }

 private:
  template <class Real>
  static Real triangle(const Real* numbers, const Real G[3][3], Real P[3][3]) {
    // 2 E = T^T G + G^T T + G^T G keeps full precision where strains are small.
    Real F[3][2], frame[3][2], E2[3], S[3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 2; ++c) {
        frame[r][c] = numbers[3 + 2 * r + c];
        F[r][c] = frame[r][c] + G[r][c];
      }
    symmetric_product(frame, G, E2);
    for (int i = 0; i < 3; ++i) {
      const int c = kColumns[i][0], d = kColumns[i][1];
      E2[i] += G[0][c] * G[0][d] + G[1][c] * G[1][d] + G[2][c] * G[2][d];
    }
    const Real value = Membrane::value_and_stress(numbers[1], numbers[0], E2, S);
    stress(F, S, P);
    return value;
  }

  template <class Real>
  static Real hinge(const Real* numbers, const Real G[3][3], Real P[3][3]) {
    Real E[3][3];
    for (int e = 0; e < 9; ++e) E[e / 3][e % 3] = numbers[4 + e] + G[e / 3][e % 3];
    const HingeAngle<Real> angle(E);
    const Bend<Real> bend = Bending::of(angle.sine, angle.cosine, angle.length, numbers[3]);
    const HingeAreas<Real> areas(angle, E, numbers[13]);
    const Real strain = areas.weight * bend.strain, moment = numbers[2] * strain;
    const Real force = moment * areas.weight * bend.slope;
    const Real tension = Real(0.0) - moment * strain * areas.slope;
    for (int r = 0; r < 3; ++r) {
      P[r][0] = force * angle.by_e[r] + tension * areas.by_e[r];
      P[r][1] = force * angle.by_a[r] + tension * areas.by_a[r];
      P[r][2] = force * angle.by_b[r] + tension * areas.by_b[r];
    }
    return Real(0.5) * moment * strain;
  }

  static void triangle_differential(const double* numbers, const double G[3][3],
                                    const double dG[3][3], double dP[3][3]) {
    double F[3][2], E2[3], S[3], dE2[3], dS[3], stress_change[3][3];
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 2; ++c) F[r][c] = numbers[3 + 2 * r + c] + G[r][c];
    for (int i = 0; i < 3; ++i) {
      const int c = kColumns[i][0], d = kColumns[i][1];
      E2[i] = F[0][c] * F[0][d] + F[1][c] * F[1][d] + F[2][c] * F[2][d] - (c == d ? 1.0 : 0.0);
    }
    symmetric_product(F, dG, dE2);
    Membrane::value_and_stress(numbers[1], numbers[0], E2, S);
    Membrane::differential(numbers[1], numbers[0], E2, dE2, dS);
    stress(F, dS, stress_change);
    const double dF[3][2] = {{dG[0][0], dG[0][1]}, {dG[1][0], dG[1][1]}, {dG[2][0], dG[2][1]}};
    stress(dF, S, dP);
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 2; ++c) dP[r][c] += stress_change[r][c];
  }

  static void hinge_differential(const double* numbers, const double G[3][3], const double dG[3][3],
                                 double dP[3][3]) {
    double E[3][3];
    for (int e = 0; e < 9; ++e) E[e / 3][e % 3] = numbers[4 + e] + G[e / 3][e % 3];
    const HingeAngle<double> angle(E);
    const Bend<double> bend = Bending::of(angle.sine, angle.cosine, angle.length, numbers[3]);
    const HingeAreas<double> areas(angle, E, numbers[13]);
    double turn = 0.0, growth = 0.0;  // changes of the angle and of rho
    for (int r = 0; r < 3; ++r) {
      turn += angle.by_e[r] * dG[r][0] + angle.by_a[r] * dG[r][1] + angle.by_b[r] * dG[r][2];
      growth += areas.by_e[r] * dG[r][0] + areas.by_a[r] * dG[r][1] + areas.by_b[r] * dG[r][2];
    }
    // With s = weight * strain, P = bending s (along ds/dtheta and ds/drho); the derivatives of the
    // weight by rho are -weight * slope and, of the slope, weight^2.
    const double s = areas.weight * bend.strain;
    const double by_angle = areas.weight * bend.slope, by_areas = -areas.slope * s;
    const double ds = by_angle * turn + by_areas * growth;
    const double d_angle =
        areas.weight * (bend.curvature * turn - areas.slope * bend.slope * growth);
    const double d_areas = -areas.weight * areas.weight * s * growth - areas.slope * ds;
    const double along_angle = ds * by_angle + s * d_angle;
    const double along_areas = ds * by_areas + s * d_areas;
    double d_by_angle[3][3], d_by_areas[3][3];
    gradient_differentials(angle, E, dG, d_by_angle, d_by_areas);
    const double* const of_angle[3] = {angle.by_e, angle.by_a, angle.by_b};
    const double* const of_areas[3] = {areas.by_e, areas.by_a, areas.by_b};
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        dP[r][c] = numbers[2] * (along_angle * of_angle[c][r] + along_areas * of_areas[c][r] +
                                 s * (by_angle * d_by_angle[r][c] + by_areas * d_by_areas[r][c]));
  }

  /// The columns of the entries xx, yy and xy.
  static constexpr int kColumns[3][2] = {{0, 0}, {1, 1}, {0, 1}};

  /// F^T G + G^T F
  template <class Real>
  static void symmetric_product(const Real F[3][2], const Real G[3][3], Real result[3]) {
    for (int i = 0; i < 3; ++i) {
      const int c = kColumns[i][0], d = kColumns[i][1];
      result[i] = (F[0][c] * G[0][d] + F[1][c] * G[1][d] + F[2][c] * G[2][d]) +
                  (G[0][c] * F[0][d] + G[1][c] * F[1][d] + G[2][c] * F[2][d]);
    }
  }

  /// P = F S; the third column is zero
  template <class Real>
  static void stress(const Real F[3][2], const Real S[3], Real P[3][3]) {
    for (int r = 0; r < 3; ++r) {
      P[r][0] = F[r][0] * S[0] + F[r][1] * S[2];
      P[r][1] = F[r][0] * S[2] + F[r][1] * S[1];
      P[r][2] = Real(0.0);
    }
  }
};

struct ShellNeoHookean : ShellDensity<PlaneNeoHookean, TangentBend> {
  static constexpr const char* kName = "shell-stable-neo-hookean";
};
struct ShellStVK : ShellDensity<PlaneStVK, TangentBend> {
  static constexpr const char* kName = "shell-stvk";
};
struct ShellNeoHookeanAngle : ShellDensity<PlaneNeoHookean, AngleBend> {
  static constexpr const char* kName = "shell-stable-neo-hookean-angle";
};
struct ShellStVKAngle : ShellDensity<PlaneStVK, AngleBend> {
  static constexpr const char* kName = "shell-stvk-angle";
};

}  // namespace snapspace
