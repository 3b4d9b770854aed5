#pragma once
#include <cstddef>
#include <new>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace snapspace {

/// Requests huge pages for large arrays on Linux: a solver that streams dozens of arrays of
/// megabytes otherwise waits for address translation. Other systems decide for themselves.
template <class T>
struct HugePages {
  using value_type = T;
  static constexpr std::size_t kPage = std::size_t{1} << 21;

  HugePages() = default;
  template <class U>
  HugePages(const HugePages<U>&) {}  // NOLINT: allocators convert

  [[nodiscard]] T* allocate(std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    void* array = ::operator new(bytes, alignment(bytes));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (bytes >= kPage) (void)madvise(array, bytes - bytes % kPage, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(array);
  }

  void deallocate(T* array, std::size_t count) {
    ::operator delete(array, alignment(count * sizeof(T)));
  }

  friend bool operator==(HugePages, HugePages) { return true; }

 private:
  static std::align_val_t alignment(std::size_t bytes) {
    constexpr std::size_t kCacheLine = 128 < alignof(T) ? alignof(T) : 128;
    return std::align_val_t{bytes >= kPage ? kPage : kCacheLine};
  }
};

/// A vector for arrays that are streamed.
template <class T>
using StreamedVector = std::vector<T, HugePages<T>>;

}  // namespace snapspace
