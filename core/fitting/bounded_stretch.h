#pragma once
#include <limits>

namespace snapspace {

/// A tet's energy e becomes e / (1 - e / bound): the same near rest, and infinite at the bound.
/// Where a surface is folded, the symmetric Dirichlet energy alone lets single tets stretch by a
/// factor of forty. In a blend such tets are a thousand times as stiff as all others: solves take
/// longer, and reduced energies need more tets.
class BoundedStretch {
 public:
  /// @param stretch  bound of the largest singular value of F, or of the inverse of the smallest,
  ///                 if the others are one
  explicit BoundedStretch(double stretch) : distortion_(stretch * stretch) {}

  /// The bounded energy and its first two derivatives by e: infinite and zeros from the bound on
  /// and for NaN.
  struct Growth {
    double value, slope, curvature;
  };

  /// @param volume  of the tet; e = volume * (|F|^2 + |F^-1|^2 - 6) / 4
  [[nodiscard]] Growth growth(double e, double volume) const {
    const double bound = 0.25 * distortion_ * volume, margin = 1.0 - e / bound;
    if (!(margin > 0.0)) return {std::numeric_limits<double>::infinity(), 0.0, 0.0};
    const double slope = 1.0 / (margin * margin);
    return {e / margin, slope, 2.0 * slope / (margin * bound)};
  }

 private:
  double distortion_;
};

}  // namespace snapspace
