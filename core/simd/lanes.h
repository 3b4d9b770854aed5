#pragma once
#include <cstring>
#include <type_traits>

#if defined(__GNUC__) && defined(__AVX__)
#include <immintrin.h>
#endif

/// One sample per SIMD lane.
///
/// A pack holds the same quantity of `Width` independent samples. Every operation is elementwise,
/// so a lane never sees its neighbours: the result of a sample is bitwise the same in any lane and
/// beside any other samples. Packs of another width compile to other code, and may round
/// differently.

namespace snapspace {

/// Maximum number of samples that a thread solves together in double precision; in single
/// precision, twice as many.
#if defined(__AVX512F__)
inline constexpr int kWideLanes = 8;
#elif defined(__AVX__)
inline constexpr int kWideLanes = 4;
#else
inline constexpr int kWideLanes = 2;
#endif

/// Registers and layout of packs depend on the processor level. Code that is compiled once for all
/// levels must not use packs.
template <class T, int Width>
#if defined(SNAPSPACE_ALL_LEVELS)
inline constexpr bool kHasPacks = false;
#else
inline constexpr bool kHasPacks = true;
#endif

/// Whether a pack needs more than one register. Such packs are two halves: compilers keep longer
/// vectors in memory, and their sums wait for stores.
template <class T, int Width>
concept WiderThanRegister = Width * sizeof(T) > kWideLanes * sizeof(double);

#if defined(__GNUC__)
// Compilers drop the attribute if the size depends on a template parameter, so every size is
// listed.
template <class T, int Width>
struct VectorOf;
template <>
struct VectorOf<double, 2> {
  typedef double type __attribute__((vector_size(16)));
};
template <>
struct VectorOf<double, 4> {
  typedef double type __attribute__((vector_size(32)));
};
template <>
struct VectorOf<double, 8> {
  typedef double type __attribute__((vector_size(64)));
};
template <>
struct VectorOf<float, 2> {
  typedef float type __attribute__((vector_size(8)));
};
template <>
struct VectorOf<float, 4> {
  typedef float type __attribute__((vector_size(16)));
};
template <>
struct VectorOf<float, 8> {
  typedef float type __attribute__((vector_size(32)));
};
template <>
struct VectorOf<float, 16> {
  typedef float type __attribute__((vector_size(64)));
};
#endif

template <class T, int Width>
struct alignas(Width * sizeof(T)) Pack {
  static_assert(kHasPacks<T, Width>);
  static constexpr int kWidth = Width;
  using Scalar = T;
#if defined(__GNUC__)
  using Vector = typename VectorOf<T, Width>::type;
  Vector v;
  Pack() = default;
  // s - 0 is s in every bit, so compilers emit a plain broadcast; 0 + s would cost an addition.
  Pack(T s) : v(s - Vector{}) {}
  explicit Pack(Vector vector) : v(vector) {}
  friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  friend Pack operator-(Pack a) { return Pack(-a.v); }
  /// Not zero in the lanes where a < b.
  friend Pack is_less(Pack a, Pack b) { return Pack(a.v < b.v ? Vector{} + T(1) : Vector{}); }
  /// a where the mask's lane is not zero, else b. Never a product: the unused side may be NaN.
  friend Pack select(Pack mask, Pack a, Pack b) { return Pack(mask.v != T(0) ? a.v : b.v); }
#else
  T v[Width];
  Pack() = default;
  Pack(T s) {
    for (T& x : v) x = s;
  }
  template <class Op>
  static Pack zip(const Pack& a, const Pack& b, Op op) {
    Pack r;
    for (int i = 0; i < Width; ++i) r.v[i] = op(a.v[i], b.v[i]);
    return r;
  }
  friend Pack operator+(const Pack& a, const Pack& b) {
    return zip(a, b, [](T x, T y) { return x + y; });
  }
  friend Pack operator-(const Pack& a, const Pack& b) {
    return zip(a, b, [](T x, T y) { return x - y; });
  }
  friend Pack operator*(const Pack& a, const Pack& b) {
    return zip(a, b, [](T x, T y) { return x * y; });
  }
  friend Pack operator/(const Pack& a, const Pack& b) {
    return zip(a, b, [](T x, T y) { return x / y; });
  }
  friend Pack operator-(const Pack& a) { return Pack(T(0)) - a; }
  friend Pack is_less(const Pack& a, const Pack& b) {
    return zip(a, b, [](T x, T y) { return x < y ? T(1) : T(0); });
  }
  friend Pack select(const Pack& mask, const Pack& a, const Pack& b) {
    Pack r;
    for (int i = 0; i < Width; ++i) r.v[i] = mask.v[i] != T(0) ? a.v[i] : b.v[i];
    return r;
  }
#endif
  T operator[](int i) const { return v[i]; }
  void set(int i, T s) { v[i] = s; }
  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  Pack& operator*=(Pack b) { return *this = *this * b; }
};

template <class T, int Width>
  requires WiderThanRegister<T, Width>
struct alignas(Width * sizeof(T)) Pack<T, Width> {
  static_assert(kHasPacks<T, Width>);
  static constexpr int kWidth = Width;
  using Scalar = T;
  using Half = Pack<T, Width / 2>;
  Half low, high;
  Pack() = default;
  Pack(T s) : low(s), high(s) {}
  Pack(Half first, Half second) : low(first), high(second) {}
  friend Pack operator+(Pack a, Pack b) { return {a.low + b.low, a.high + b.high}; }
  friend Pack operator-(Pack a, Pack b) { return {a.low - b.low, a.high - b.high}; }
  friend Pack operator*(Pack a, Pack b) { return {a.low * b.low, a.high * b.high}; }
  friend Pack operator/(Pack a, Pack b) { return {a.low / b.low, a.high / b.high}; }
  friend Pack operator-(Pack a) { return {-a.low, -a.high}; }
  friend Pack is_less(Pack a, Pack b) { return {is_less(a.low, b.low), is_less(a.high, b.high)}; }
  friend Pack select(Pack mask, Pack a, Pack b) {
    return {select(mask.low, a.low, b.low), select(mask.high, a.high, b.high)};
  }
  T operator[](int i) const { return i < Width / 2 ? low[i] : high[i - Width / 2]; }
  void set(int i, T s) { i < Width / 2 ? low.set(i, s) : high.set(i - Width / 2, s); }
  Pack& operator+=(Pack b) { return *this = *this + b; }
  Pack& operator-=(Pack b) { return *this = *this - b; }
  Pack& operator*=(Pack b) { return *this = *this * b; }
};

template <int Width>
using Lanes = Pack<double, Width>;
template <int Width>
using SingleLanes = Pack<float, Width>;

/// One half of a pack, and the pack of two halves.
template <bool High, class T, int Width>
inline Pack<T, Width / 2> half(Pack<T, Width> pack) {
  if constexpr (WiderThanRegister<T, Width>) {
    return High ? pack.high : pack.low;
  } else {
    Pack<T, Width / 2> result;
    std::memcpy(&result, reinterpret_cast<const char*>(&pack) + (High ? sizeof result : 0),
                sizeof result);
    return result;
  }
}
template <class T, int Half>
inline Pack<T, 2 * Half> joined(Pack<T, Half> low, Pack<T, Half> high) {
  Pack<T, 2 * Half> result;
  std::memcpy(&result, &low, sizeof low);
  std::memcpy(reinterpret_cast<char*>(&result) + sizeof low, &high, sizeof high);
  return result;
}

/// The same numbers in another precision.
template <class To, class From, int Width>
inline Pack<To, Width> cast(Pack<From, Width> a) {
  if constexpr (std::is_same_v<To, From>) {
    return a;
#if defined(__GNUC__) && defined(__AVX__)  // compilers emit two conversions for these
  } else if constexpr (Width == 4) {
    if constexpr (std::is_same_v<To, double>)
      return Pack<To, 4>((typename Pack<To, 4>::Vector)_mm256_cvtps_pd((__m128)a.v));
    else
      return Pack<To, 4>((typename Pack<To, 4>::Vector)_mm256_cvtpd_ps((__m256d)a.v));
#endif
#if defined(__GNUC__) && defined(__AVX512F__)
  } else if constexpr (Width == 8) {
    if constexpr (std::is_same_v<To, double>)
      return Pack<To, 8>((typename Pack<To, 8>::Vector)_mm512_cvtps_pd((__m256)a.v));
    else
      return Pack<To, 8>((typename Pack<To, 8>::Vector)_mm512_cvtpd_ps((__m512d)a.v));
#endif
  } else if constexpr (WiderThanRegister<To, Width> || WiderThanRegister<From, Width>) {
    return joined(cast<To>(half<false>(a)), cast<To>(half<true>(a)));
  } else {
#if defined(__GNUC__)
    return Pack<To, Width>(__builtin_convertvector(a.v, typename Pack<To, Width>::Vector));
#else
    Pack<To, Width> r;
    for (int i = 0; i < Width; ++i) r.v[i] = static_cast<To>(a.v[i]);
    return r;
#endif
  }
}

/// A product that is rounded before it is added. Compilers contract one product of a sum of two
/// into a multiply-add, and not the same one for packs of every width.
template <class T, int Width>
inline Pack<T, Width> rounded(Pack<T, Width> product) {
  if constexpr (WiderThanRegister<T, Width>) {
    return {rounded(product.low), rounded(product.high)};
  } else {
#if defined(__GNUC__) && defined(__FMA__)
    asm("" : "+v"(product.v));
#elif defined(__GNUC__) && defined(__aarch64__)
    asm("" : "+w"(product.v));
#endif
    return product;
  }
}

inline double rounded(double product) { return product; }

/// The type of a lane; a number counts as a pack of one.
template <class Real>
struct ScalarOf {
  using type = Real;
};
template <class T, int Width>
struct ScalarOf<Pack<T, Width>> {
  using type = T;
};

inline void set_lane(double& x, int, double value) { x = value; }
/// Sets one lane.
template <class T, int Width>
void set_lane(Pack<T, Width>& x, int lane, double value) {
  x.set(lane, static_cast<T>(value));
}

/// Sums of many terms are taken in double precision, even if the terms are in single precision.
inline double widened(double a) { return a; }
template <class T, int Width>
inline Lanes<Width> widened(Pack<T, Width> a) {
  return cast<double>(a);
}
template <class Real>
using Sum = decltype(widened(Real()));

}  // namespace snapspace
