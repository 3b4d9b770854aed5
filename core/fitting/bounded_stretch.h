#pragma once
#include <limits>

namespace snapspace {

/// A tet's energy e as e / (1 - e / most): the same at rest, and infinite at `most`.
///
/// Where a surface is folded, the symmetric Dirichlet energy alone lets single tets be stretched
/// forty times. As parts of a blend these are a thousand times as stiff as all others: solves take
/// longer, and reduced energies need more tets.
class BoundedStretch {
 public:
  /// @param stretch  the largest singular value of F, or the inverse of the smallest, if the others
  ///                 are one
  explicit BoundedStretch(double stretch) : distortion_(stretch * stretch) {}

  /// Energy and its first two derivatives by e, infinite and zero from the bound on, or for NaN.
  struct Growth {
    double value, slope, curvature;
  };

  /// @param volume  of the tet; e = volume * (|F|^2 + |F^-1|^2 - 6) / 4
  [[nodiscard]] Growth of(double e, double volume) const {
    const double most = 0.25 * distortion_ * volume, room = 1.0 - e / most;
    if (!(room > 0.0)) return {std::numeric_limits<double>::infinity(), 0.0, 0.0};
    const double slope = 1.0 / (room * room);
    return {e / room, slope, 2.0 * slope / (room * most)};
  }

 private:
  double distortion_;
};

}  // namespace snapspace
