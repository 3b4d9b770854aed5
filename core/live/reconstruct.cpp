#include "live/reconstruct.h"

#include "online/reconstruct.h"

namespace snapspace::live {

void reconstruct(std::size_t size, int dimension, const double* tau, const double* modes,
                 const double* q, double* shape) {
  online::reconstruct(size, dimension, tau, modes, q, shape);
}

}  // namespace snapspace::live
