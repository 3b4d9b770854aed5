#pragma once
#include "snapshots/linear_response.h"
#include "snapshots/posing_system.h"

namespace snapspace {

/// Shapes near the solutions for large motions of the handles, made without solving: combinations
/// of linear responses are shears where they should be rotations, so every tet gets the deformation
/// that rotation_strain makes of theirs, and the shape is the one of the nearest deformations, in
/// the norm of the scalar matrix, with the handles where they are asked to be.
///
/// But for what responses are solved to, exact for a rigid motion of all handles, and off by the
/// square of small ones. With a multigrid cycle in place of the inverse the nearest shape is found
/// to a few percent.
///
/// @param coordinates    samples x response.count()
/// @param inputs         samples x system.input_size(), asked of the pinned vertices
/// @param displacements  samples x 3n, in the caller's numbering
void warp(const PosingSystem& system, const LinearResponse& response, const double* coordinates,
          const double* inputs, int samples, double* displacements);

}  // namespace snapspace
