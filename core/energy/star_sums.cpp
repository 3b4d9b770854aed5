// The inner loops over stars. Only this file instantiates them, for every pack.
#include "energy/vertex_stars.h"
#include "material/shell_arap.h"

namespace snapspace {

namespace {

/// Nine numbers as a matrix.
template <class Real, class T>
void load(const T* numbers, Real M[3][3]) {
  for (int e = 0; e < 9; ++e) M[e / 3][e % 3] = Real(numbers[e]);
}

}  // namespace

template <class Real>
void VertexStars::gradient_of(int star, const Real* u, Real H[3][3]) const {
  using T = typename ScalarOf<Real>::type;
  const Real* const u0 = u + 3 * static_cast<std::size_t>(center(star));
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) H[r][c] = Real(T(0));
  const T* gradient = numbers<T>().gradients.data();
  // the first corner is the center
  for (int k = first_corner[star] + 1; k < first_corner[star + 1]; ++k) {
    const Real* const uk = u + 3 * static_cast<std::size_t>(corners[k]);
    const T* const g = gradient + 3 * static_cast<std::size_t>(k);
    for (int r = 0; r < 3; ++r) {
      const Real edge = uk[r] - u0[r];
      for (int c = 0; c < 3; ++c) H[r][c] += edge * Real(g[c]);
    }
  }
}

/// The sum over stars of weight |G - turn T|^2, and its gradient for a fixed turn.
/// @param turn  turn(star, L, H, result) sets R - I, or its change
template <class Real, class Turn>
Sum<Real> VertexStars::add_stars(int begin, int end, const Real* u, Real* gradient,
                                 const Turn& turn) const {
  using T = typename ScalarOf<Real>::type;
  const Numbers<T>& all = numbers<T>();
  Sum<Real> energy(0.0);
  for (int star = begin; star < end; ++star) {
    Real L[3][3], H[3][3], W[3][3];
    load(&all.frames[9 * static_cast<std::size_t>(star)], L);
    gradient_of(star, u, H);
    turn(star, L, H, W);
    Real sum(T(0));
    for (int k = first_triangle[star]; k < first_triangle[star + 1]; ++k) {
      const Triangle<T>& t = all.triangles[triangles[k]];
      const std::size_t a = 3 * static_cast<std::size_t>(t.vertices[0]),
                        b = 3 * static_cast<std::size_t>(t.vertices[1]),
                        c = 3 * static_cast<std::size_t>(t.vertices[2]);
      const T share = all.shares[k] * t.weight;
      const Real weight(share), twice(share + share);
      for (int r = 0; r < 3; ++r) {
        const Real first = u[b + r] - u[a + r], second = u[c + r] - u[a + r];
        Real x = first * Real(t.first[0]), y = first * Real(t.first[1]);
        y += second * Real(t.second);
        for (int s = 0; s < 3; ++s) {
          x -= W[r][s] * Real(t.frame[s][0]);
          y -= W[r][s] * Real(t.frame[s][1]);
        }
        sum += weight * (x * x + rounded(y * y));
        Real at_b = x * Real(t.first[0]);
        at_b += y * Real(t.first[1]);
        at_b = twice * at_b;
        const Real at_c = twice * (y * Real(t.second));
        gradient[a + r] -= at_b + at_c;
        gradient[b + r] += at_b;
        gradient[c + r] += at_c;
      }
    }
    energy += widened(sum);
  }
  return energy;
}

template <class Real>
Sum<Real> VertexStars::add_value_and_gradient(int begin, int end, const Real* u,
                                              Real* gradient) const {
  return add_stars(begin, end, u, gradient,
                   [](int, const Real L[3][3], const Real H[3][3], Real turn[3][3]) {
                     nearest_turn(L, H, turn);
                   });
}

template <class Real>
void VertexStars::add_rest_product(const Real* v, Real* product) const {
  using T = typename ScalarOf<Real>::type;
  // S - S^T = [w] M + M [w] = [(tr(M) I - M) w] for a small rotation vector w
  (void)add_stars(0, count(), v, product,
                  [this](int star, const Real L[3][3], const Real H[3][3], Real turn[3][3]) {
                    const double* inverse = &inverse_inertias_[9 * static_cast<std::size_t>(star)];
                    Real torque[3], w[3];
                    for (int r = 0; r < 3; ++r) {
                      const int s = (r + 1) % 3, t = (r + 2) % 3;
                      torque[r] = Real(T(0));
                      for (int c = 0; c < 3; ++c)
                        torque[r] += H[t][c] * L[s][c] - rounded(H[s][c] * L[t][c]);
                    }
                    for (int r = 0; r < 3; ++r) {
                      w[r] = Real(T(0));
                      for (int c = 0; c < 3; ++c)
                        w[r] += Real(static_cast<T>(inverse[3 * r + c])) * torque[c];
                    }
                    for (int r = 0; r < 3; ++r) {
                      const int s = (r + 1) % 3, t = (r + 2) % 3;
                      turn[r][r] = Real(T(0));
                      turn[t][s] = w[r];
                      turn[s][t] = Real(T(0)) - w[r];
                    }
                  });
}

void VertexStars::add_hessian_product(const double* u, const double* v, double* product) const {
  (void)add_stars(0, count(), v, product,
                  [&](int star, const double L[3][3], const double dH[3][3], double turn[3][3]) {
                    double F[3][3], S[3][3], dS[3][3];
                    gradient_of(star, u, F);
                    for (int e = 0; e < 9; ++e) F[e / 3][e % 3] += L[e / 3][e % 3];
                    multiply_transposed(F, L, S);
                    multiply_transposed(dH, L, dS);
                    RotationDerivative(S).of(dS, turn);
                  });
}

#define SNAPSPACE_DEFINED(Real)                                                               \
  template Sum<Real> VertexStars::add_value_and_gradient(int, int, const Real*, Real*) const; \
  template void VertexStars::add_rest_product(const Real*, Real*) const;
SNAPSPACE_LANE_PACKS(SNAPSPACE_DEFINED)
#undef SNAPSPACE_DEFINED
template void VertexStars::gradient_of(int, const double*, double[3][3]) const;

}  // namespace snapspace
