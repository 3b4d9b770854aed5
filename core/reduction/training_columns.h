#pragma once
#include <cstddef>

namespace snapspace {

/// The states that a cubature is trained on, with stresses and directions in each.
struct TrainingStates {
  int count, directions;
  int numbers;            ///< per element: nine, or nine for each pose of blended stars
  const float* stresses;  ///< count x candidates x numbers, derivatives of the energies
  const float* along;     ///< count x dimension x directions
};

/// Products of the forces of single tets with some directions, state by state: for candidate c and
/// state s the numbers along_s^T G_c^T P_sc.
/// A force of 9 numbers first becomes one of d numbers, and then `directions` numbers: 2 d (9 +
/// directions) operations in single precision for each candidate and state. Poses of a star add
/// only to the first part. All their data except the results stay in the processor's caches.
/// @param rows  candidates x numbers x dimension, the maps G_c
/// @param stride  distance between the numbers of one candidate and those of the next
/// @param columns  candidates x stride; the first count x directions of each are overwritten
/// @param threads  0: as many as the machine has. The result is bitwise the same for any number
void training_columns(int dimension, int candidates, const float* rows,
                      const TrainingStates& states, int threads, std::size_t stride,
                      float* columns);

}  // namespace snapspace
