#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "energy/blended_energy.h"

namespace snapspace {

/// The Hessian of an elastic energy with each 3 x 3 block replaced by a third of its trace: an n x
/// n matrix that, applied to x, y and z, preconditions the Hessian. Where strains are small it is a
/// multiple of the Laplacian; where tets are stretched it stiffens as the material does.
/// In the frame of V the trace is diagonal: the block of vertices j and k with hat gradients b is
/// volume * b_j^T V D V^T b_k, D_c = (scaling_cc + sum of the two same_ac) / 3. Singular values are
/// raised to at least one, and eigenvalues of the curvature to at least zero, so the matrix is
/// semi-definite.
class ScalarHessian {
 public:
  explicit ScalarHessian(const RestShape& rest)
      : rest_(rest), locals_(rest.tets.size(), Eigen::Matrix4d::Zero()) {}

  /// Adds weight times the Hessian at displacements u, on all threads. The energy may have another
  /// rest shape of the same tets.
  void add(const ElasticEnergy& energy, const double* u, double weight);

  /// Adds weight times the Hessian of a sum over poses, if it has_scalar_hessians(). The rest shape
  /// is pose 0. The cost does not depend on the number of poses, and no stretches are raised.
  void add(const BlendedEnergy& energy, const double* weights, const double* u, double weight);

  /// The sum so far; singular, since it does not change under translations.
  [[nodiscard]] Eigen::SparseMatrix<double> matrix() const { return rest_.assembled(locals_); }

 private:
  template <class AddTets>
  void add_pieces(AddTets add_tets);
  void add_tets(const ElasticEnergy& energy, const double* u, double weight, int begin, int end);

  const RestShape& rest_;
  std::vector<Eigen::Matrix4d> locals_;
};

}  // namespace snapspace
