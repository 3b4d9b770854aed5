#include "snapshots/coarse_space.h"

#include <utility>

namespace snapspace {

CoarseSpace::CoarseSpace(const Numbering& numbering, const double* modes, int dimension,
                         std::size_t size)
    : dimension_(dimension) {
  constexpr int kCount = EightModes::kCount;
  std::vector<double> mode(size);
  for (int first = 0; first < dimension; first += kCount) {
    StreamedVector<float> entries(size * kCount, 0.0f);
    for (int k = 0; k < kCount && first + k < dimension; ++k) {
      numbering.to_internal(modes + (first + k) * size, mode.data());
      for (std::size_t i = 0; i < size; ++i) entries[i * kCount + k] = static_cast<float>(mode[i]);
    }
    blocks_.emplace_back(std::move(entries));
  }
}

}  // namespace snapspace
