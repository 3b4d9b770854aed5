#pragma once
#include <cstdint>
#include <vector>

#include "material/tet_material.h"
#include "online/pin_springs.h"
#include "online/residual_probe.h"

namespace snapspace::online {

/// What the residual of an as-rigid-as-possible surface at some places depends on. The
/// energy is a quadratic form plus a sum over stars, see VertexStars, so its gradient at a place is
/// a linear function of the shape plus the stresses of the stars around it, times vectors. The
/// numbers of a pose are 9 per star, and then that function, 3 per place.
struct ProbeStars {
  int dimension, poses, stars, places;
  const double* origins;  ///< poses x (9 stars + 3 places), the numbers at tau
  const float* modes;     ///< poses x dimension x (9 stars + 3 places), those of the modes
  TetMaterial material;   ///< of poses x stars rows
  int parts;              ///< pairs of a star and a place that its stress pulls at
  const std::int32_t* part_stars;
  const std::int32_t* part_places;
  const double* part_vectors;  ///< poses x parts x 3
  const double* weights;       ///< places, of the squared residuals there
};

/// The residual at places of an as-rigid-as-possible surface.
class StarProbe : public ResidualProbe {
 public:
  /// Copies all arrays. Indices must be in range. The linear functions include the part of the
  /// pins' pull that depends on displacements.
  StarProbe(const ProbeStars& stars, const ProbePins& pins);

  double norm(const double* q, int dimension, const double* offsets,
              const double* weights) override;

 private:
  void find_stresses(const double* moduli);

  int stars_, kind_;
  std::size_t size_;  // numbers of a pose
  std::vector<double> origins_, moduli_;
  std::vector<float> modes_;
  std::vector<std::int32_t> part_stars_, part_places_;
  std::vector<double> part_vectors_, weights_;
  PinSprings pins_;
  std::vector<double> numbers_, stresses_;  // numbers of a pose; 9 stresses per star
  std::vector<double> gradient_;            // 3 per place
};

}  // namespace snapspace::online
