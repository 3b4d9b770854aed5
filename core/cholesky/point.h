#pragma once
#include <cstring>

#include "simd/lanes.h"

namespace snapspace {

/// Whether a register holds two of these packs.
template <class Real>
inline constexpr bool kTwoInARegister = false;
template <class T, int Width>
inline constexpr bool kTwoInARegister<Pack<T, Width>> =
    2 * Width * sizeof(T) <= kWideLanes * sizeof(double);

/// x, y and z of a vertex in all lanes, in memory order and in as few registers as possible.
template <class Real, bool Paired = kTwoInARegister<Real>>
class Point {
 public:
  static Point at(const Real* from) {
    Point point;
    for (int c = 0; c < 3; ++c) point.xyz_[c] = from[c];
    return point;
  }
  void store(Real* to) const {
    for (int c = 0; c < 3; ++c) to[c] = xyz_[c];
  }
  static Point zero() {
    Point point;
    for (Real& x : point.xyz_) x = Real(0);
    return point;
  }
  void add(const Point& other) {
    for (int c = 0; c < 3; ++c) xyz_[c] += other.xyz_[c];
  }
  /// this -= scale * other
  void subtract(typename ScalarOf<Real>::type scale, const Point& other) {
    const Real factor(scale);
    for (int c = 0; c < 3; ++c) xyz_[c] -= factor * other.xyz_[c];
  }

 private:
  Real xyz_[3];
};

/// Packs are narrow when few samples are left. Here x and y share a pack of twice the width, and z
/// has its own. Lanes never mix, so results are bitwise those of three packs.
template <class T, int Width>
class Point<Pack<T, Width>, true> {
 public:
  static Point at(const Pack<T, Width>* from) {
    Point point;
    std::memcpy(&point.xy_, from, sizeof(point.xy_));
    point.z_ = from[2];
    return point;
  }
  void store(Pack<T, Width>* to) const {
    std::memcpy(to, &xy_, sizeof(xy_));
    to[2] = z_;
  }
  static Point zero() {
    Point point;
    point.xy_ = T(0);
    point.z_ = T(0);
    return point;
  }
  void add(const Point& other) {
    xy_ += other.xy_;
    z_ += other.z_;
  }
  void subtract(T scale, const Point& other) {
    xy_ -= Pack<T, 2 * Width>(scale) * other.xy_;
    z_ -= Pack<T, Width>(scale) * other.z_;
  }

 private:
  Pack<T, 2 * Width> xy_;
  Pack<T, Width> z_;
};

}  // namespace snapspace
