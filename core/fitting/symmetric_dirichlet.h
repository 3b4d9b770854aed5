#pragma once
#include "energy/block_hessian.h"
#include "mesh/rest_shape.h"

namespace snapspace {

/// |F|^2 + |F^-1|^2 of every tet. Six for rotations, and without bound as a tet collapses.
using Distortions = std::vector<double>;

/// Symmetric Dirichlet energy: the sum of volume * psi with psi = (|F|^2 + |F^-1|^2 - 6) / 4 [Smith
/// & Schaefer 2015], at displacements u. For small strains psi is |E|^2, that of St.VK with mu = 1
/// and lam = 0.
///
/// Where a tet is inverted the energy is infinite, and so it is here where a distortion exceeds its
/// limit: a line search from a shape without inverted tets then never leaves those, and no tet is
/// crushed by a step that suits the others.
///
/// @param limits       largest distortions that are allowed
/// @param gradient     3n, overwritten; of no use where the energy is infinite
/// @param distortions  overwritten, likewise
[[nodiscard]] double symmetric_dirichlet(const RestShape& rest, const double* u,
                                         const Distortions& limits, double* gradient,
                                         Distortions& distortions);

/// Its Hessian at displacements u without inverted tets, every element's projected to the nearest
/// positive semi-definite one.
///
/// With F = U diag(s) V^T the density is sum_i g(s_i), g(s) = (s^2 + s^-2 - 2) / 4, and the nine
/// eigenpairs of an element have a closed form [Smith, de Goes, Kim 2019]: scalings u_i v_i^T with
/// g''(s_i), and for each pair i, j the sum and the difference of u_i v_j^T and u_j v_i^T with
/// (g'(s_i) -+ g'(s_j)) / (s_i -+ s_j). Only the difference can have a negative one.
void assemble_projected(const RestShape& rest, const double* u, BlockHessian& hessian);

}  // namespace snapspace
