#pragma once
#include <cstddef>
#include <type_traits>

#include "memory/streamed_vector.h"

namespace snapspace {

/// Memory for intermediate arrays of any type, kept from one use to the next.
class Scratch {
 public:
  /// An array with undefined content. Invalidates the one before.
  template <class T>
  [[nodiscard]] T* array(std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
    if (bytes_.size() < count * sizeof(T)) bytes_.resize(count * sizeof(T));
    return reinterpret_cast<T*>(bytes_.data());
  }

 private:
  StreamedVector<std::byte> bytes_;
};

}  // namespace snapspace
