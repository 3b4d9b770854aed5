#pragma once
#include <vector>

#include "energy/elastic_energy.h"

namespace snapspace {

/// Coefficients of the reduced elastic energy E(offset + sum_i q_i mode_i), a polynomial of degree
/// four in q, in the order of online::Quartic (paper, sec. 6.1).
///
/// The strain of a tet is a quadratic function of q, and its energy a squared norm of the strain,
/// so the coefficients are sums of entries of one Gram matrix A^T A with six rows per tet and a
/// column for each of 1, q_i, q_i q_j. A is made and multiplied panel by panel. Cost: 6 m (d^2/2)^2
/// multiply-adds for m tets. Every entry is summed in the same order for any number of threads.
///
/// @param modes    (d + 1) x 3n row-major, displacements from rest: the offset, then the basis
/// @throws std::invalid_argument  for a material other than St.Venant-Kirchhoff
/// @param threads  0: as many as the machine has
[[nodiscard]] std::vector<double> quartic_coefficients(const ElasticEnergy& energy,
                                                       const double* modes, int dimension,
                                                       int threads);

}  // namespace snapspace
