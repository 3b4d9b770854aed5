#pragma once
#include <bit>
#include <cstdint>

#include "simd/lanes.h"

/// Two numbers in the 64 bits of one double: double-precision arithmetic with the memory of single
/// precision.
/// The upper halves of two doubles, with 20 bits of mantissa each, share a word. Read as a double,
/// the word is the first number: the second one is only noise beyond its 20 bits, and rounding
/// accounts for it. One shift gives the second number. Conversions from float cost three times as
/// much, and compilers split those of whole packs.
namespace snapspace {

/// The word of two finite numbers, each to a relative 2^-21. The caller must ensure that the first
/// is neither zero nor so small that products with it are denormal, which is slow.
inline double number_pair(double first, double second) {
  constexpr std::uint64_t kHalf = 0x80000000u;
  const std::uint64_t low = (std::bit_cast<std::uint64_t>(second) + kHalf) >> 32;
  const std::uint64_t high = (std::bit_cast<std::uint64_t>(first) - low + kHalf) >> 32;
  return std::bit_cast<double>(high << 32 | low);
}

/// The second numbers of a pack of words; the first ones are the words themselves.
template <int Width>
inline Lanes<Width> second_numbers(Lanes<Width> words) {
#if defined(__GNUC__)
  using Bits = decltype(words.v != words.v);  // the same number of 64-bit integers
  return Lanes<Width>((typename Lanes<Width>::Vector)((Bits)words.v << 32));
#else
  for (int i = 0; i < Width; ++i)
    words.set(i, std::bit_cast<double>(std::bit_cast<std::uint64_t>(words[i]) << 32));
  return words;
#endif
}

}  // namespace snapspace
