#pragma once
#include <cstdint>
#include <vector>

#include "element/rest_tet.h"
#include "material/tet_material.h"
#include "online/star_gradient.h"

namespace snapspace::online {

/// The tets around some vertices of a body, and the shapes tau + sum_i q_i modes_i of their
/// corners. Of a surface that is as rigid as possible they are the triangles around these vertices
/// and their neighbours, whose rotations the residual depends on.
struct ProbeBody {
  int dimension, corners, tets;
  int rests;                        ///< 1, or the number of poses that are blended
  const double* tau;                ///< corners x 3
  const double* modes;              ///< dimension x 3 corners
  const double* rest_shapes;        ///< rests x corners x 3; no tet without volume
  const std::int32_t* tet_corners;  ///< tets x 4
  TetMaterial material;             ///< of these tets
};

/// Corners where the residual is evaluated, and the weights of its squares there.
struct ProbeSample {
  int count;
  const std::int32_t* corners;
  const double* weights;
};

/// Sampled corners that handles hold by springs.
struct ProbePins {
  int count = 0;
  const std::int32_t* corners = nullptr;
  const std::int32_t* handles = nullptr;
  const double* pulls = nullptr;  ///< twice the weights of the springs
  const double* arms = nullptr;   ///< count x 3, from the handle's centroid at rest
};

/// The full objective's gradient g at a sample of vertices. It is exact there if all tets around
/// them are given, and its cost does not depend on the mesh. Allocates no memory after
/// construction.
class ResidualProbe {
 public:
  /// Copies all arrays. Indices must be in range.
  ResidualProbe(const ProbeBody& body, const ProbeSample& sample, const ProbePins& pins);

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int rests() const { return rests_; }

  /// sqrt(sum_v weight_v |g_v|^2) at tau + sum of q_i modes_i over the first `dimension` modes.
  /// @param offsets  handles x 12, [A - I | t] about the centroids; null without pins
  /// @param weights  rests, weights of the energies relative to them; null for ones
  double norm(const double* q, int dimension, const double* offsets, const double* weights);

 private:
  void set_rest_numbers(const std::int32_t* corners);
  void add_elastic(const double* rest_shape, const RestTet* tets, const double* moduli,
                   double weight);
  void add_pins(const double* offsets);

  int dimension_, corners_, rests_;
  int kind_, moduli_per_tet_;  // the density, and the stride of moduli; 0 if all tets share them
  std::vector<double> tau_, modes_, rest_shapes_;
  std::vector<double> moduli_;  // of a shell those of every rest shape
  std::vector<RestTet> tets_;   // of the first rest shape, then of the next
  std::vector<std::int32_t> sampled_, pinned_, handles_;
  std::vector<double> sample_weights_, pulls_, arms_;
  std::vector<double> shape_, displacement_, gradient_;  // corners x 3
  StarGradient stars_;
};

}  // namespace snapspace::online
