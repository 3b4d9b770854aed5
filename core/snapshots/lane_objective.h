#pragma once
#include <memory>

#include "mesh/sweep.h"
#include "simd/lanes.h"

namespace snapspace {

struct SampleSeed;

/// The single-precision pack for the same samples, in which they are preconditioned. A number stays
/// as it is.
template <class Real>
struct SinglePackOf {
  using type = Real;
};
template <class T, int Width>
struct SinglePackOf<Pack<T, Width>> {
  using type = SingleLanes<Width>;
};

/// The objective of the samples that are now in the lanes: all that L-BFGS knows of a problem. Real
/// is a pack, in the precision of shapes and gradients, or double for a single sample.
template <class Real>
class LaneObjective {
 public:
  using Single = typename SinglePackOf<Real>::type;

  virtual ~LaneObjective() = default;

  [[nodiscard]] virtual int size() const = 0;
  /// Decreases below this count as zero.
  [[nodiscard]] virtual double negligible() const = 0;
  /// Loads the input of a sample into a lane (input_size() numbers of the system).
  virtual void load(int lane, const double* input) = 0;
  /// What the seed of a sample depends on near a shape u (3n); null if it is the same everywhere.
  [[nodiscard]] virtual std::shared_ptr<const SampleSeed> seed_near(const double* /*input*/,
                                                                    const double* /*u*/) const {
    return nullptr;
  }
  /// Gives a lane a seed that an objective of the same system has made, or none.
  virtual void load_seed(int /*lane*/, std::shared_ptr<const SampleSeed> /*seed*/) {}
  /// F at u (3n). Its gradient overwrites `gradient`; the visitor sees only complete entries.
  virtual Sum<Real> value_and_gradient(const Real* u, Real* gradient, SweepVisitor& visitor) = 0;
  /// result = the seed of the inverse Hessian times vector, both 3n; they may be the same array.
  /// Returns vector . result.
  virtual Sum<Single> precondition(const Single* vector, Single* result) = 0;
};

}  // namespace snapspace
