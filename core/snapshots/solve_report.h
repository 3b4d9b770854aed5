#pragma once
#include <atomic>

namespace snapspace {

enum class SolveStatus : int {
  converged = 0,
  max_iterations = 1,
  line_search_failed = 2,
  not_finite = 3,
  cancelled = 4,
};

/// How the solve of one sample ended.
struct SolveReport {
  SolveStatus status = SolveStatus::cancelled;
  int iterations = 0;
  int evaluations = 0;
  double value = 0.0;          ///< objective at the returned shape
  double gradient_norm = 0.0;  ///< Euclidean norm of its gradient
  double decrement = 0.0;      ///< -g.d of the last direction d: twice the predicted decrease
  double seconds = 0.0;        ///< wall time from taking the sample to finishing it
  int inverted_tets = 0;
};

struct SolveOptions {
  double tolerance = 1e-5;  ///< converged when decrement <= tolerance * value; see Lane::converged
  /// L-BFGS only: also converged when the last directions together are no longer than this share of
  /// the displacement, in the norm of the lumped masses; 0: never.
  double settling = 0.0;
  int max_iterations = 500;
  int lanes = 16;       ///< maximum number of samples in a pack
  bool single = false;  ///< packs in single precision
  int threads = 0;      ///< 0: as many as the machine has
};

/// Shared with a running solve by another thread.
struct SolveControl {
  std::atomic<bool> cancelled{
      false};  ///< if set, the solve ends soon, and unfinished samples are `cancelled`
  std::atomic<int> finished{0};  ///< samples done so far
};

}  // namespace snapspace
