#pragma once
#include <cstddef>
#include <cstdint>

namespace snapspace {

/// Displacement gradients of modes in some tets: entry 3 a + b of the second index of `rows` is d
/// u_a / d x_b. Differences of nodal values are taken first: sums over all four corners would lose
/// digits on slivers.
/// @param vertices  n x 3, at rest
/// @param modes  dimension x size, mode by mode; size is 3 n
/// @param shell  whether the tets are triangles and hinges, see element/rest_shell.h
/// @param corners  tets x 4; no tet without volume
/// @param rows  tets x 9 x dimension, overwritten
/// @param threads  0: as many as the machine has
void mode_gradients(const double* vertices, int dimension, std::size_t size, const double* modes,
                    bool shell, int tets, const std::int32_t* corners, float* rows, int threads);

}  // namespace snapspace
