#pragma once
#include <cstddef>

namespace snapspace {

/// States that a cubature is trained on, with what is asked of each.
struct TrainingStates {
  int count, directions;
  const float* stresses;  ///< count x candidates x 9, by the tets' displacement gradients
  const float* along;     ///< count x dimension x directions
};

/// How far the forces of single tets reach along some directions, state by state: for candidate c
/// and state s the numbers along_s^T G_c^T P_sc.
///
/// A force of 9 numbers becomes one of d first, and then `directions` numbers: 2 d (9 + directions)
/// operations in single precision for each candidate and state, of which the core's caches hold all
/// but the results.
/// @param rows  candidates x 9 x dimension, the maps G_c
/// @param stride  from the numbers of one candidate to those of the next
/// @param columns  candidates x stride, of which the first count x directions are overwritten
/// @param threads  0: all. The result is bitwise the same for any number
void training_columns(int dimension, int candidates, const float* rows,
                      const TrainingStates& states, int threads, std::size_t stride,
                      float* columns);

}  // namespace snapspace
