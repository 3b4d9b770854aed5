#include "snapshots/run_lanes_of.h"

namespace snapspace {

template void run_lanes<kLongMemory>(const LaneObjectives&, int, const SolveOptions&,
                                     const ThreadShare&, SampleExchange&, const SolveControl&);

}  // namespace snapspace
