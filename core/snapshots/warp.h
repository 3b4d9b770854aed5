#pragma once
#include "snapshots/linear_response.h"
#include "snapshots/posing_system.h"

namespace snapspace {

/// Shapes near the solutions for large motions of the handles, without a nonlinear solve.
/// Combinations of linear responses shear where they should rotate. So rotation_strain gives the
/// target deformation of each tet, and the shape is the one whose deformations are nearest to the
/// targets, in the norm of the scalar matrix, with the handles at their targets.
/// Up to the accuracy of the responses it is exact for a rigid motion of all handles, and the error
/// is of second order in small motions. With a multigrid cycle instead of the inverse the nearest
/// shape is found to a few percent.
///
/// @param coordinates    samples x response.count()
/// @param inputs         samples x system.input_size(), targets of the pinned vertices
/// @param displacements  samples x 3n, in the caller's numbering
void warp(const PosingSystem& system, const LinearResponse& response, const double* coordinates,
          const double* inputs, int samples, double* displacements);

}  // namespace snapspace
