#pragma once
#include <utility>

namespace snapspace {

/// A number that is known when it is compiled.
template <int Value>
struct Constant {
  constexpr operator int() const { return Value; }
};

/// work(i) for i = First ... Last - 1, each a Constant: arrays that only such indices reach stay in
/// registers.
template <int First, int Last, class Work>
inline void unrolled(Work&& work) {
  [&]<int... I>(std::integer_sequence<int, I...>) {
    (work(Constant<First + I>()), ...);
  }(std::make_integer_sequence<int, Last - First>());
}

}  // namespace snapspace
