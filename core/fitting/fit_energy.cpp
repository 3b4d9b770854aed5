#include "fitting/fit_energy.h"

#include <algorithm>

#include "element/tet.h"

namespace snapspace {

FitEnergy::FitEnergy(const ElasticEnergy& energy, double stretch)
    : energy_(energy), bound_(stretch) {}

void FitEnergy::evaluate(const double* u, std::vector<double>& energies,
                         std::vector<double>& stresses) const {
  energies.resize(energy_.tets());
  stresses.resize(9 * energies.size());
  energy_.tet_stresses(u, stresses.data(), energies.data());
  for (std::size_t t = 0; t < energies.size(); ++t) {
    const auto growth = bound_.growth(energies[t], energy_.rest.tets[t].volume);
    energies[t] = growth.value;
    for (std::size_t i = 9 * t; i < 9 * t + 9; ++i) stresses[i] *= growth.slope;
  }
}

void FitEnergy::add_gradient(const std::vector<double>& stresses, double* gradient) const {
  for (std::size_t t = 0; t < energy_.rest.tets.size(); ++t) {
    double P[3][3];
    std::copy_n(&stresses[9 * t], 9, &P[0][0]);
    scatter_stress(energy_.rest.tets[t], P, gradient);
  }
}

/// With b(e) = e / (1 - e / bound) the Hessian is b' d2e + b'' de (x) de. Because b' and b'' are
/// positive, it is semi-definite if d2e is.
void FitEnergy::add_hessian(const double* u, BlockHessian& hessian) const {
  std::vector<double> energies(energy_.tets()), stresses(9 * energies.size());
  energy_.tet_stresses(u, stresses.data(), energies.data());
  std::vector<double> slopes(energies.size());
  for (std::size_t t = 0; t < energies.size(); ++t) {
    const RestTet& tet = energy_.rest.tets[t];
    const auto growth = bound_.growth(energies[t], tet.volume);
    slopes[t] = growth.slope;
    double forces[4][3] = {};
    for (int j = 0; j < 3; ++j)
      for (int r = 0; r < 3; ++r) {
        const double *P = &stresses[9 * t + 3 * r], *edge = tet.inverse_edges[j];
        forces[j + 1][r] = P[0] * edge[0] + P[1] * edge[1] + P[2] * edge[2];
        forces[0][r] -= forces[j + 1][r];
      }
    hessian.add_outer_product(static_cast<int>(t), forces, growth.curvature);
  }
  hessian.add(energy_, u, Projection::clamp, 0.0, slopes.data());
}

}  // namespace snapspace
