#pragma once
#include <utility>

namespace snapspace {

/// A compile-time integer.
template <int Value>
struct Constant {
  constexpr operator int() const { return Value; }
};

/// Calls work(i) for i = First ... Last - 1, each a Constant: arrays indexed only by Constants stay
/// in registers.
template <int First, int Last, class Work>
inline void unrolled(Work&& work) {
  [&]<int... I>(std::integer_sequence<int, I...>) {
    (work(Constant<First + I>()), ...);
  }(std::make_integer_sequence<int, Last - First>());
}

}  // namespace snapspace
