#pragma once
#include <cstddef>

namespace snapspace {

/// Asks for the lines of a cache that hold `count` objects. Compilers drop calls to a function that
/// does nothing but prefetch, unless they must inline it.
template <class T>
[[gnu::always_inline]] inline void prefetch([[maybe_unused]] const T* begin,
                                            [[maybe_unused]] std::size_t count) {
#if defined(__GNUC__)
  const auto* bytes = reinterpret_cast<const char*>(begin);
  for (std::size_t at = 0; at < count * sizeof(T); at += 64) __builtin_prefetch(bytes + at);
#endif
}

}  // namespace snapspace
