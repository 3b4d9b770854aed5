#pragma once

namespace snapspace {

/// The samples of one call: what a problem asks of each, where it starts, where its shape goes.
struct Samples {
  int count = 0;
  const double* inputs = nullptr;  ///< count x input_size() of the system
  const double* starts = nullptr;  ///< count x 3n, displacements
  double* shapes = nullptr;        ///< count x 3n, displacements; written as samples finish
};

inline void set_lane(double& x, int, double value) { x = value; }
/// The same for one lane of a pack.
template <class Pack>
void set_lane(Pack& x, int lane, double value) {
  x.set(lane, value);
}

}  // namespace snapspace
