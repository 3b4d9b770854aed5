#include "live/shape_rows.h"

#include <algorithm>
#include <cmath>
#include <thread>

#include "online/reconstruct.h"
#include "threads/parallel.h"

namespace snapspace::live {

namespace {

/// Coordinates per block: their sums stay in the first-level cache.
constexpr std::size_t kBlock = 2048;
/// With fewer bytes per thread, starting one takes as long as it saves.
constexpr std::size_t kBytesPerThread = 4u << 20;
constexpr double kLargestCount = 32767.0;

}  // namespace

ShapeRows::ShapeRows(std::size_t size, int dimension, const double* tau, const double* modes)
    : fine_count_(std::min(kFine, dimension)),
      coarse_count_(dimension - fine_count_),
      tau_(tau, tau + size),
      fine_(size * fine_count_),
      coarse_(size * coarse_count_),
      units_((size + kBlock - 1) / kBlock * coarse_count_) {
  for (std::size_t begin = 0; begin < size; begin += kBlock) take_block(begin, modes);
}

void ShapeRows::take_block(std::size_t begin, const double* modes) {
  const std::size_t length = std::min(kBlock, size() - begin);
  const double* mode = modes + begin;
  float* fine = fine_.data() + begin * fine_count_;
  for (int i = 0; i < fine_count_; ++i, mode += size())
    fine =
        std::transform(mode, mode + length, fine, [](double x) { return static_cast<float>(x); });
  std::int16_t* coarse = coarse_.data() + begin * coarse_count_;
  float* unit = units_.data() + begin / kBlock * coarse_count_;
  for (int i = 0; i < coarse_count_; ++i, mode += size(), ++unit) {
    double largest = 0.0;
    for (std::size_t k = 0; k < length; ++k) largest = std::max(largest, std::abs(mode[k]));
    *unit = static_cast<float>(largest / kLargestCount);
    // Entries too small for a float count as zero. The unit is a float, rounded up or down, so the
    // largest entry must be clamped to 32767 units.
    const double per_unit = *unit > 0.0f ? 1.0 / *unit : 0.0;
    coarse = std::transform(mode, mode + length, coarse, [=](double x) {
      const double count = std::nearbyint(x * per_unit);
      return static_cast<std::int16_t>(std::clamp(count, -kLargestCount, kLargestCount));
    });
  }
}

void ShapeRows::shape(const double* q, int count, int threads, float* shape) const {
  const auto blocks = static_cast<int>((size() + kBlock - 1) / kBlock);
  if (threads <= 0) {
    const std::size_t read = bytes() * count / std::max(1, dimension());
    const auto useful = static_cast<int>(read / kBytesPerThread);
    threads = std::clamp(useful, 1, std::max<int>(1, std::thread::hardware_concurrency()));
  }
  parallel_for(blocks, threads, [&](int b) { write_block(b * kBlock, q, count, shape); });
}

void ShapeRows::write_block(std::size_t begin, const double* q, int count, float* shape) const {
  const std::size_t length = std::min(kBlock, size() - begin);
  const int fine = std::min(count, fine_count_);
  float sums[kBlock] = {};
  online::add_modes(fine_.data() + begin * fine_count_, length, fine, q, length, sums);
  add_coarse(begin, q + fine, count - fine, sums);
  for (std::size_t k = 0; k < length; ++k)
    shape[begin + k] = static_cast<float>(tau_[begin + k] + sums[k]);
}

/// @param q  coordinates of the later modes, `count` of them
void ShapeRows::add_coarse(std::size_t begin, const double* q, int count, float* sums) const {
  constexpr int kChunk = 64;
  const std::size_t length = std::min(kBlock, size() - begin);
  const std::int16_t* modes = coarse_.data() + begin * coarse_count_;
  const float* units = units_.data() + begin / kBlock * coarse_count_;
  for (int first = 0; first < count; first += kChunk) {
    const int chunk = std::min(kChunk, count - first);
    double factors[kChunk];
    for (int i = 0; i < chunk; ++i) factors[i] = q[first + i] * units[first + i];
    online::add_modes(modes + first * length, length, chunk, factors, length, sums);
  }
}

}  // namespace snapspace::live
