#pragma once
#include <cstddef>
#include <vector>

namespace snapspace::online {

/// An array, initially zero, at an address that is a multiple of 64: no pack of its numbers
/// straddles two cache lines.
template <class T>
class AlignedArray {
 public:
  AlignedArray() = default;
  explicit AlignedArray(std::size_t size) : size_(size), lines_((size + kPerLine - 1) / kPerLine) {}

  [[nodiscard]] std::size_t size() const { return size_; }

  [[nodiscard]] T* data() { return reinterpret_cast<T*>(lines_.data()); }
  [[nodiscard]] const T* data() const { return reinterpret_cast<const T*>(lines_.data()); }

  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }

 private:
  static constexpr std::size_t kPerLine = 64 / sizeof(T);
  struct alignas(64) Line {
    T numbers[kPerLine] = {};
  };
  std::size_t size_ = 0;
  std::vector<Line> lines_;
};

}  // namespace snapspace::online
