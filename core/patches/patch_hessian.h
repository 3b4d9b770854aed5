#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "energy/blended_energy.h"
#include "energy/vertex_stars.h"
#include "online/dense_cholesky.h"
#include "patches/rigid_patches.h"
#include "patches/tet_sample.h"

namespace snapspace {

/// The Hessian of an as-rigid-as-possible surface, or of a blended solid, at a shape, with respect
/// to rigid motions of its patches about their centers.
class PatchHessian {
 public:
  /// @param u  the shape, displaced from the positions of the patches (3n)
  PatchHessian(const RigidPatches& patches, const double* u);

  /// A part of the energy: weight times that of stars.
  struct Part {
    const VertexStars* stars;
    double weight;
  };
  /// Adds the energy of parts, whose stars have the same corners. Weights may be negative.
  void add(const std::vector<Part>& parts);
  /// Adds the energy of a solid at u for these weights, as estimated from a sample of its tets.
  void add(const BlendedEnergy& energy, const TetSample& sample, const double* weights,
           const double* u);

  /// The Cholesky factor; none if the shape is not finite. Translations of the whole body have no
  /// energy; they are made as stiff as those of single patches. Where the Hessian is not
  /// positive definite, a multiple of the Dirichlet energy's is added, as Newton's method shifts
  /// Hessians (Nocedal & Wright 2006, sec. 3.4).
  [[nodiscard]] std::optional<online::DenseCholesky> factor();

  /// Centers of the patches, three each.
  [[nodiscard]] const std::vector<double>& centers() const { return centers_; }
  /// Positions of the vertices at the shape, from the mean of all, 3n.
  [[nodiscard]] const std::vector<double>& positions() const { return positions_; }

 private:
  static constexpr int kMotions = RigidPatches::kMotions;
  static constexpr int kPadded = 8;                    // numbers of a vector register
  using MotionRow = Eigen::Array<double, kPadded, 1>;  // a number for each motion, and two zeros
  using MotionRows = std::array<MotionRow, 9>;
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;
  using Homogeneous = Eigen::Vector4d;  // a hat times (1, x)
  using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  using Moments = Eigen::Matrix<double, 4, 3>;  // sums of these (x) gradients over corners

  [[nodiscard]] Vector position(int vertex) const {
    return Eigen::Map<const Vector>(&positions_[3 * static_cast<std::size_t>(vertex)]);
  }
  [[nodiscard]] Vector center(int patch) const {
    return Eigen::Map<const Vector>(&centers_[3 * static_cast<std::size_t>(patch)]);
  }
  [[nodiscard]] Homogeneous homogeneous(int vertex, double hat) const {
    Homogeneous result;
    result << 1.0, position(vertex);
    return hat * result;
  }
  void add_stars(const std::vector<Part>& parts, int star);
  void add_rotation(const Part& part, int star);
  void add_couplings(const VertexStars& pattern, const std::vector<double>& couplings);
  void forget_touched();
  std::size_t touch(std::int32_t patch, int count);
  void find_hats(int count, const std::int32_t* corners);
  void find_motions(const RestTet& tet);
  void add_products(const double H[9][9], double stiffness);
  void hold_translations();
  void hold_small_patches();

  const RigidPatches& patches_;
  std::vector<double> positions_, centers_;
  Square dirichlet_, rotations_;  // lower triangles: the Dirichlet energy, and the rest
  double shift_ = 3e-3;           // share of the Dirichlet energy's Hessian that is always added
  // for a star: the patches that it touches, their hats at its corners, and the effect of their
  // motions on its rotation in a part
  std::vector<std::int32_t> touched_;
  std::vector<int> slots_;  // place of every patch in these, or -1
  std::vector<Homogeneous> hats_;
  std::vector<Moments> moments_;
  std::vector<Eigen::Matrix<double, kMotions, 3>> felt_;
  // for a tet: the entries of its displacement gradient for the motions of each touched patch, and
  // its Hessian times these
  std::vector<MotionRows> gradients_, stresses_;
};

}  // namespace snapspace
