#pragma once
#include <utility>

#include "energy/block_hessian.h"
#include "energy/elastic_energy.h"
#include "fitting/surface_springs.h"
#include "mesh/locality.h"
#include "snapshots/numbering.h"

namespace snapspace {

/// The data that all poses of one mesh and surface share. Only the targets differ from pose to
/// pose.
struct FittingSystem {
  Numbering numbering;
  ElasticEnergy energy;  ///< symmetric Dirichlet, of unit shear modulus
  SurfaceSprings springs;
  BlockHessian pattern;  ///< copied by every fit

  FittingSystem(const LocalMesh& mesh, SurfaceSprings surface)
      : numbering(mesh.order),
        energy(RestShape(mesh.vertices.data(), static_cast<int>(mesh.order.size()),
                         mesh.tets.data(), static_cast<int>(mesh.tets.size() / 4)),
               MaterialField(SymmetricDirichlet::kName, {1.0}, 1)),
        springs(std::move(surface)),
        pattern(energy.rest) {}

  [[nodiscard]] int size() const { return 3 * energy.rest.vertex_count; }
};

}  // namespace snapspace
