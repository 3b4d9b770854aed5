#pragma once
namespace snapspace {

/// Lame parameters of small strains: psi = mu |e|^2 + lam/2 tr(e)^2 + O(e^3).
struct Lame {
  double lam;
  double mu;
  /// The largest stiffness, that of a strain along one axis.
  [[nodiscard]] double stiffness() const { return 2.0 * mu + lam; }
};

}  // namespace snapspace
