#pragma once
#include <cstdint>
#include <vector>

#include "element/rest_tet.h"
#include "material/tet_material.h"
#include "online/pin_springs.h"
#include "online/residual_probe.h"

namespace snapspace::online {

/// The tets around some vertices of a body, or the elements of a shell, and the shapes tau +
/// sum_i q_i modes_i of their corners.
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

/// The residual at corners of few tets: all tets around a sampled corner must be given.
class ElementProbe : public ResidualProbe {
 public:
  /// Copies all arrays. Indices must be in range, and the density a function of single tets.
  ElementProbe(const ProbeBody& body, const ProbeSample& sample, const ProbePins& pins);

  double norm(const double* q, int dimension, const double* offsets,
              const double* weights) override;

 private:
  void set_rest_numbers(const std::int32_t* corners);
  void add_elastic(const double* rest_shape, const RestTet* tets, const double* moduli,
                   double weight);

  int corners_;
  int kind_, moduli_per_tet_;  // the density, and the stride of moduli; 0 if all tets share them
  std::vector<double> tau_, modes_, rest_shapes_;
  std::vector<double> moduli_;  // for a shell, those of every rest shape
  std::vector<RestTet> tets_;   // tets of the first rest shape, then of the next
  std::vector<std::int32_t> sampled_;
  std::vector<double> sample_weights_;
  PinSprings pins_;
  std::vector<double> shape_, displacement_, gradient_;  // corners x 3
};

}  // namespace snapspace::online
