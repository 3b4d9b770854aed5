#pragma once
/// One sample per SIMD lane.
///
/// `Lanes` holds the same quantity of kLaneCount independent samples. Every operation is
/// elementwise, so a lane never sees its neighbours: the result of a sample is bitwise the same in
/// any lane, beside any other samples.

#include <cstdint>

namespace snapspace {

#if defined(__AVX512F__)
inline constexpr int kLaneCount = 8;
#elif defined(__AVX__)
inline constexpr int kLaneCount = 4;
#else
inline constexpr int kLaneCount = 2;
#endif

struct alignas(kLaneCount * sizeof(double)) Lanes {
#if defined(__GNUC__)
  typedef double Vector __attribute__((vector_size(kLaneCount * sizeof(double))));
  Vector v;
  Lanes() = default;
  Lanes(double s) : v(Vector{} + s) {}
  explicit Lanes(Vector vector) : v(vector) {}
  double operator[](int i) const { return v[i]; }
  void set(int i, double s) { v[i] = s; }
  friend Lanes operator+(Lanes a, Lanes b) { return Lanes(a.v + b.v); }
  friend Lanes operator-(Lanes a, Lanes b) { return Lanes(a.v - b.v); }
  friend Lanes operator*(Lanes a, Lanes b) { return Lanes(a.v * b.v); }
  friend Lanes operator-(Lanes a) { return Lanes(-a.v); }
  /// a where the mask's lane is not zero, else b. Never a product: the unused side may be NaN.
  friend Lanes select(Lanes mask, Lanes a, Lanes b) { return Lanes(mask.v != 0.0 ? a.v : b.v); }
#else
  double v[kLaneCount];
  Lanes() = default;
  Lanes(double s) {
    for (double& x : v) x = s;
  }
  double operator[](int i) const { return v[i]; }
  void set(int i, double s) { v[i] = s; }
  template <class Op>
  static Lanes zip(const Lanes& a, const Lanes& b, Op op) {
    Lanes r;
    for (int i = 0; i < kLaneCount; ++i) r.v[i] = op(a.v[i], b.v[i]);
    return r;
  }
  friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return zip(a, b, [](double x, double y) { return x + y; });
  }
  friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return zip(a, b, [](double x, double y) { return x - y; });
  }
  friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return zip(a, b, [](double x, double y) { return x * y; });
  }
  friend Lanes operator-(const Lanes& a) { return Lanes(0.0) - a; }
  friend Lanes select(const Lanes& mask, const Lanes& a, const Lanes& b) {
    Lanes r;
    for (int i = 0; i < kLaneCount; ++i) r.v[i] = mask.v[i] != 0.0 ? a.v[i] : b.v[i];
    return r;
  }
#endif
  Lanes& operator+=(Lanes b) { return *this = *this + b; }
  Lanes& operator-=(Lanes b) { return *this = *this - b; }
  Lanes& operator*=(Lanes b) { return *this = *this * b; }
};

}  // namespace snapspace
