#pragma once

namespace snapspace::online {

/// The full objective's gradient g at a sample of vertices. It is exact there, and its cost does
/// not depend on the mesh. Allocates no memory after construction.
class ResidualProbe {
 public:
  ResidualProbe(int dimension, int rests) : dimension_(dimension), rests_(rests) {}
  ResidualProbe(const ResidualProbe&) = delete;
  ResidualProbe& operator=(const ResidualProbe&) = delete;
  virtual ~ResidualProbe() = default;

  /// Number of modes.
  [[nodiscard]] int dimension() const { return dimension_; }
  /// Number of shapes at rest: 1, or the number of poses that are blended.
  [[nodiscard]] int rests() const { return rests_; }

  /// sqrt(sum_v weight_v |g_v|^2) at tau + sum of q_i modes_i over the first `dimension` modes.
  /// @param offsets  handles x 12, [A - I | t] about the centroids; null without pins
  /// @param weights  rests, weights of the energies relative to them; null for ones
  virtual double norm(const double* q, int dimension, const double* offsets,
                      const double* weights) = 0;

 private:
  int dimension_, rests_;
};

}  // namespace snapspace::online
