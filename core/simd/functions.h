#pragma once
#include <algorithm>
#include <cmath>

#include "simd/lanes.h"

/// Functions of packs, lane by lane, and the same functions for numbers.
namespace snapspace {

inline double sqrt(double a) { return std::sqrt(a); }
inline float sqrt(float a) { return std::sqrt(a); }
inline double max(double a, double b) { return std::max(a, b); }
/// Not zero where a < b.
inline double is_less(double a, double b) { return a < b ? 1.0 : 0.0; }
inline double select(double mask, double a, double b) { return mask != 0.0 ? a : b; }

template <class T, int Width>
inline Pack<T, Width> sqrt(Pack<T, Width> a) {
  if constexpr (WiderThanRegister<T, Width>) {
    return {sqrt(a.low), sqrt(a.high)};
  } else {
    // Compilers turn the loop into one instruction only if square roots need not set errno.
#if defined(__GNUC__) && defined(__AVX512F__)
    if constexpr (Width * sizeof(T) == 64) {
      if constexpr (sizeof(T) == 4)
        return Pack<T, Width>((typename Pack<T, Width>::Vector)_mm512_sqrt_ps((__m512)a.v));
      else
        return Pack<T, Width>((typename Pack<T, Width>::Vector)_mm512_sqrt_pd((__m512d)a.v));
    }
#endif
#if defined(__GNUC__) && defined(__AVX__)
    if constexpr (Width * sizeof(T) == 32) {
      if constexpr (sizeof(T) == 4)
        return Pack<T, Width>((typename Pack<T, Width>::Vector)_mm256_sqrt_ps((__m256)a.v));
      else
        return Pack<T, Width>((typename Pack<T, Width>::Vector)_mm256_sqrt_pd((__m256d)a.v));
    }
#endif
    Pack<T, Width> result;
    for (int i = 0; i < Width; ++i) result.set(i, std::sqrt(a[i]));
    return result;
  }
}

template <class T, int Width>
inline Pack<T, Width> max(Pack<T, Width> a, Pack<T, Width> b) {
  return select(is_less(a, b), b, a);
}

/// Whether any lane has its sign bit set, to skip work that no lane needs. Results must not depend
/// on whether it was skipped.
inline bool any_negative(double a) { return std::signbit(a); }
template <class T, int Width>
inline bool any_negative(Pack<T, Width> a) {
  if constexpr (WiderThanRegister<T, Width>) {
    return any_negative(a.low) || any_negative(a.high);
  } else {
#if defined(__GNUC__) && defined(__AVX512DQ__)
    if constexpr (sizeof(T) * Width == 64) {
      if constexpr (sizeof(T) == 4)
        return _mm512_movepi32_mask((__m512i)a.v) != 0;
      else
        return _mm512_movepi64_mask((__m512i)a.v) != 0;
    }
#endif
#if defined(__GNUC__) && defined(__AVX__)
    if constexpr (sizeof(T) * Width == 32) {
      if constexpr (sizeof(T) == 4)
        return _mm256_movemask_ps((__m256)a.v) != 0;
      else
        return _mm256_movemask_pd((__m256d)a.v) != 0;
    }
#endif
    bool any = false;
    for (int i = 0; i < Width; ++i) any |= std::signbit(a[i]);
    return any;
  }
}

/// Lanes of the processor's rough inverses that are used for a pack of this width; 0 if it has
/// none.
template <class T, int Width>
inline constexpr int kRoughLanes =
#if defined(__GNUC__) && defined(__AVX__)
    sizeof(T) == sizeof(float) ? (Width < 4 ? 4 : Width) : 0;
#else
    0;
#endif

/// About 1 / a and 1 / sqrt(a), to at least 11 bits, for a > 0 that is neither tiny nor huge: for
/// iterations that correct their own errors. Exact except for packs in single precision on x86,
/// where divisions and roots of wide packs take ten times as long. Results are bitwise the same in
/// packs of every width.
inline double rough_inverse(double a) { return 1.0 / a; }
inline double rough_inverse_sqrt(double a) { return 1.0 / std::sqrt(a); }

template <class T, int Width>
inline Pack<T, Width> rough_inverse(Pack<T, Width> a) {
  if constexpr (WiderThanRegister<T, Width>) {
    return {rough_inverse(a.low), rough_inverse(a.high)};
  } else if constexpr (kRoughLanes<T, Width> > Width) {
    return half<false>(rough_inverse(joined(a, a)));
  } else {
#if defined(__GNUC__) && defined(__AVX512VL__)
    using Vector = typename Pack<T, Width>::Vector;
    if constexpr (kRoughLanes<T, Width> == 16)
      return Pack<T, Width>((Vector)_mm512_rcp14_ps((__m512)a.v));
    else if constexpr (kRoughLanes<T, Width> == 8)
      return Pack<T, Width>((Vector)_mm256_rcp14_ps((__m256)a.v));
    else if constexpr (kRoughLanes<T, Width> == 4)
      return Pack<T, Width>((Vector)_mm_rcp14_ps((__m128)a.v));
    else
#elif defined(__GNUC__) && defined(__AVX__)
    using Vector = typename Pack<T, Width>::Vector;
    if constexpr (kRoughLanes<T, Width> == 8)
      return Pack<T, Width>((Vector)_mm256_rcp_ps((__m256)a.v));
    else if constexpr (kRoughLanes<T, Width> == 4)
      return Pack<T, Width>((Vector)_mm_rcp_ps((__m128)a.v));
    else
#endif
      return Pack<T, Width>(T(1)) / a;
  }
}

template <class T, int Width>
inline Pack<T, Width> rough_inverse_sqrt(Pack<T, Width> a) {
  if constexpr (WiderThanRegister<T, Width>) {
    return {rough_inverse_sqrt(a.low), rough_inverse_sqrt(a.high)};
  } else if constexpr (kRoughLanes<T, Width> > Width) {
    return half<false>(rough_inverse_sqrt(joined(a, a)));
  } else {
#if defined(__GNUC__) && defined(__AVX512VL__)
    using Vector = typename Pack<T, Width>::Vector;
    if constexpr (kRoughLanes<T, Width> == 16)
      return Pack<T, Width>((Vector)_mm512_rsqrt14_ps((__m512)a.v));
    else if constexpr (kRoughLanes<T, Width> == 8)
      return Pack<T, Width>((Vector)_mm256_rsqrt14_ps((__m256)a.v));
    else if constexpr (kRoughLanes<T, Width> == 4)
      return Pack<T, Width>((Vector)_mm_rsqrt14_ps((__m128)a.v));
    else
#elif defined(__GNUC__) && defined(__AVX__)
    using Vector = typename Pack<T, Width>::Vector;
    if constexpr (kRoughLanes<T, Width> == 8)
      return Pack<T, Width>((Vector)_mm256_rsqrt_ps((__m256)a.v));
    else if constexpr (kRoughLanes<T, Width> == 4)
      return Pack<T, Width>((Vector)_mm_rsqrt_ps((__m128)a.v));
    else
#endif
      return Pack<T, Width>(T(1)) / sqrt(a);
  }
}

}  // namespace snapspace
