#pragma once
/// One sample per SIMD lane.
///
/// A pack holds the same quantity of `Width` independent samples. Every operation is elementwise,
/// so a lane never sees its neighbours: the result of a sample is bitwise the same in any lane and
/// beside any other samples. Packs of another width are other code, and may round differently.

namespace snapspace {

/// Samples that a thread solves together at most in double precision; in single twice as many.
#if defined(__AVX512F__)
inline constexpr int kWideLanes = 8;
#elif defined(__AVX__)
inline constexpr int kWideLanes = 4;
#else
inline constexpr int kWideLanes = 2;
#endif

#if defined(__GNUC__)
// Compilers drop the attribute where the size depends on a template parameter: every size is named.
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
struct VectorOf<double, 16> {
  typedef double type __attribute__((vector_size(128)));
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
  static constexpr int kWidth = Width;
  using Scalar = T;
#if defined(__GNUC__)
  using Vector = typename VectorOf<T, Width>::type;
  Vector v;
  Pack() = default;
  // s - 0 is s in every bit, so compilers leave a plain broadcast; 0 + s would cost an addition.
  Pack(T s) : v(s - Vector{}) {}
  explicit Pack(Vector vector) : v(vector) {}
  friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  friend Pack operator-(Pack a) { return Pack(-a.v); }
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
  friend Pack operator-(const Pack& a) { return Pack(T(0)) - a; }
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

template <int Width>
using Lanes = Pack<double, Width>;
template <int Width>
using SingleLanes = Pack<float, Width>;

/// The same numbers in another precision.
template <class To, class From, int Width>
inline Pack<To, Width> cast(Pack<From, Width> a) {
#if defined(__GNUC__)
  return Pack<To, Width>(__builtin_convertvector(a.v, typename Pack<To, Width>::Vector));
#else
  Pack<To, Width> r;
  for (int i = 0; i < Width; ++i) r.v[i] = static_cast<To>(a.v[i]);
  return r;
#endif
}

/// What a lane holds; a number is a pack of one.
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

/// Sums of many terms are taken in double precision, also of terms in single precision.
inline double widened(double a) { return a; }
template <class T, int Width>
inline Lanes<Width> widened(Pack<T, Width> a) {
  return cast<double>(a);
}
template <class Real>
using Sum = decltype(widened(Real()));

}  // namespace snapspace
