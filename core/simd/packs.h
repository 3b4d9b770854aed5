#pragma once
#include "simd/lanes.h"

/// X(pack) for all packs of samples that this build solves with. Long templates over packs are
/// defined in a source file and instantiated there for these packs; headers only declare them.
#if defined(SNAPSPACE_ALL_LEVELS)
#define SNAPSPACE_SINGLE_LANE_PACKS(X)
#define SNAPSPACE_DOUBLE_LANE_PACKS(X)
#elif defined(__AVX512F__)
#define SNAPSPACE_SINGLE_LANE_PACKS(X) \
  X(SingleLanes<2>) X(SingleLanes<4>) X(SingleLanes<8>) X(SingleLanes<16>)
#define SNAPSPACE_DOUBLE_LANE_PACKS(X) X(Lanes<2>) X(Lanes<4>) X(Lanes<8>)
#elif defined(__AVX__)
#define SNAPSPACE_SINGLE_LANE_PACKS(X) X(SingleLanes<2>) X(SingleLanes<4>) X(SingleLanes<8>)
#define SNAPSPACE_DOUBLE_LANE_PACKS(X) X(Lanes<2>) X(Lanes<4>)
#else
#define SNAPSPACE_SINGLE_LANE_PACKS(X) X(SingleLanes<2>) X(SingleLanes<4>)
#define SNAPSPACE_DOUBLE_LANE_PACKS(X) X(Lanes<2>)
#endif
#define SNAPSPACE_LANE_PACKS(X) SNAPSPACE_SINGLE_LANE_PACKS(X) SNAPSPACE_DOUBLE_LANE_PACKS(X)
/// The same packs, and double.
#define SNAPSPACE_PACKS(X) SNAPSPACE_LANE_PACKS(X) X(double)

namespace snapspace {

template <class... Real>
struct PackList {};

#define SNAPSPACE_LISTED(Real) , Real
template <class Ignored, class... Real>
struct Listed {
  using Packs = PackList<Real...>;
};
/// All of SNAPSPACE_LANE_PACKS as a type.
using LanePacks = Listed<void SNAPSPACE_LANE_PACKS(SNAPSPACE_LISTED)>::Packs;
#undef SNAPSPACE_LISTED

}  // namespace snapspace
