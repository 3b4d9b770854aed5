#pragma once
#include <utility>

#include "energy/block_hessian.h"
#include "fitting/surface_springs.h"
#include "mesh/rest_shape.h"
#include "snapshots/numbering.h"

namespace snapspace {

/// What all poses of one mesh and surface share. Only the targets differ from pose to pose.
struct FittingSystem {
  Numbering numbering;
  RestShape rest;
  SurfaceSprings springs;
  BlockHessian pattern;  ///< copied by every fit

  FittingSystem(const LocalMesh& mesh, SurfaceSprings surface)
      : numbering(mesh.order),
        rest(mesh.vertices.data(), static_cast<int>(mesh.order.size()), mesh.tets.data(),
             static_cast<int>(mesh.tets.size() / 4)),
        springs(std::move(surface)),
        pattern(rest) {}

  [[nodiscard]] int size() const { return 3 * rest.vertex_count; }

  /// Energy of a strain of 1e-12 everywhere: a decrease below this is none.
  [[nodiscard]] double negligible() const { return 1e-24 * rest.volume(); }
};

}  // namespace snapspace
