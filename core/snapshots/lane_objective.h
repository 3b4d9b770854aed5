#pragma once
#include "mesh/sweep.h"
#include "simd/lanes.h"

namespace snapspace {

/// The pack of the same samples in single precision, in which they are preconditioned; a number
/// stays as it is.
template <class Real>
struct SinglePackOf {
  using type = Real;
};
template <class T, int Width>
struct SinglePackOf<Pack<T, Width>> {
  using type = SingleLanes<Width>;
};

/// The objective of the samples that are in the lanes now: all that L-BFGS knows of a problem. Real
/// is a pack, in the precision of shapes and gradients, or double for a single sample.
template <class Real>
class LaneObjective {
 public:
  using Single = typename SinglePackOf<Real>::type;

  virtual ~LaneObjective() = default;

  [[nodiscard]] virtual int size() const = 0;
  /// A decrease below this is none.
  [[nodiscard]] virtual double negligible() const = 0;
  /// The lane takes the input of a sample (input_size() numbers of the system).
  virtual void load(int lane, const double* input) = 0;
  /// F at u (3n); its gradient overwrites `gradient`, and the visitor sees it whole.
  virtual Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) = 0;
  /// result = the seed of the inverse Hessian times vector, both 3n; they may be the same array.
  /// Returns vector . result.
  virtual Sum<Single> precondition(const Single* vector, Single* result) = 0;
};

}  // namespace snapspace
