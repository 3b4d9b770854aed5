#pragma once
#include <vector>

#include "energy/block_hessian.h"
#include "energy/elastic_energy.h"
#include "fitting/bounded_stretch.h"

namespace snapspace {

/// The symmetric Dirichlet energy of unit shear modulus, with bounded stretch in each tet.
class FitEnergy {
 public:
  FitEnergy(const ElasticEnergy& energy, double stretch);

  /// Energies (tets) and first Piola-Kirchhoff stresses times volume (tets x 9) at displacements u.
  void evaluate(const double* u, std::vector<double>& energies,
                std::vector<double>& stresses) const;

  /// Adds the gradient (3n) of these stresses.
  void add_gradient(const std::vector<double>& stresses, double* gradient) const;

  /// Adds the Hessian at u, projected tet by tet. For tets at rest it is that of the symmetric
  /// Dirichlet energy; tets at or beyond the bound add nothing.
  void add_hessian(const double* u, BlockHessian& hessian) const;

 private:
  const ElasticEnergy& energy_;
  BoundedStretch bound_;
};

}  // namespace snapspace
