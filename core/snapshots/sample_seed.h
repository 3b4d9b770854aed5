#pragma once
#include <vector>

namespace snapspace {

/// The part of a seed that belongs to one sample: the inverse Hessian for rigid motions of patches
/// at a shape, see PatchHessian.
struct SampleSeed {
  std::vector<float> positions;  ///< of the vertices at that shape, 3n
  std::vector<double> centers;   ///< of the patches, three each
  std::vector<float> inverse;    ///< d x d
};

}  // namespace snapspace
