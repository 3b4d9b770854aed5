#include "live/shape_rows.h"

#include <algorithm>
#include <thread>

#include "online/reconstruct.h"
#include "threads/parallel.h"

namespace snapspace::live {

namespace {

/// Coordinates of a block: their sums stay in the first-level cache.
constexpr std::size_t kBlock = 2048;
/// Below so many bytes for each thread, beginning one takes as long as it saves.
constexpr std::size_t kBytesPerThread = 12u << 20;

}  // namespace

ShapeRows::ShapeRows(std::size_t size, int dimension, const double* tau, const double* modes)
    : dimension_(dimension), tau_(tau, tau + size), rows_(size * dimension) {
  float* row = rows_.data();
  for (std::size_t begin = 0; begin < size; begin += kBlock) {
    const std::size_t count = std::min(kBlock, size - begin);
    for (int i = 0; i < dimension; ++i, row += count) {
      const double* mode = modes + static_cast<std::size_t>(i) * size + begin;
      std::transform(mode, mode + count, row, [](double x) { return static_cast<float>(x); });
    }
  }
}

void ShapeRows::shape(const double* q, int count, int threads, float* shape) const {
  const auto blocks = static_cast<int>((size() + kBlock - 1) / kBlock);
  if (threads <= 0) {
    const std::size_t read = size() * count * sizeof(float);
    const auto useful = static_cast<int>(read / kBytesPerThread);
    threads = std::clamp(useful, 1, std::max<int>(1, std::thread::hardware_concurrency()));
  }
  parallel_for(blocks, threads, [&](int b) { block(b * kBlock, q, count, shape); });
}

void ShapeRows::block(std::size_t begin, const double* q, int count, float* shape) const {
  const std::size_t length = std::min(kBlock, size() - begin);
  float sums[kBlock] = {};
  online::add_modes(rows_.data() + begin * dimension_, length, count, q, length, sums);
  for (std::size_t k = 0; k < length; ++k)
    shape[begin + k] = static_cast<float>(tau_[begin + k] + sums[k]);
}

}  // namespace snapspace::live
