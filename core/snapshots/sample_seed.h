#pragma once
#include <vector>

#include "online/dense_cholesky.h"

namespace snapspace {

/// The part of a seed that belongs to one sample: the Hessian for rigid motions of patches at a
/// shape, see PatchHessian.
struct SampleSeed {
  std::vector<float> positions;  ///< positions of the vertices at that shape, 3n
  std::vector<double> centers;   ///< centers of the patches, three each
  online::DenseCholesky factor;
};

}  // namespace snapspace
