#include "energy/scalar_hessian.h"

#include <algorithm>

#include "energy/projection.h"
#include "material/signed_svd.h"
#include "threads/parallel.h"

namespace snapspace {

template <class AddTets>
void ScalarHessian::add_pieces(AddTets add_tets) {
  constexpr int kPiece = 4096;
  const auto tets = static_cast<int>(locals_.size());
  parallel_for((tets + kPiece - 1) / kPiece, 0, [&](int piece) {
    const int begin = piece * kPiece;
    add_tets(begin, std::min(begin + kPiece, tets));
  });
}

void ScalarHessian::add(const ElasticEnergy& energy, const double* u, double weight) {
  add_pieces([&](int begin, int end) { add_tets(energy, u, weight, begin, end); });
}

void ScalarHessian::add(const BlendedEnergy& energy, const double* weights, const double* u,
                        double weight) {
  add_pieces([&](int begin, int end) {
    for (int t = begin; t < end; ++t) {
      double D[3][3];
      energy.scalar_hessian(t, weights, u, D);
      const Eigen::Matrix<double, 4, 3> b = hat_gradients(rest_.tets[t]);
      locals_[t] += weight * b * Eigen::Map<const Eigen::Matrix3d>(&D[0][0]) * b.transpose();
    }
  });
}

void ScalarHessian::add_tets(const ElasticEnergy& energy, const double* u, double weight, int begin,
                             int end) {
  const TetMaterial material = energy.material.view();
  for (int t = begin; t < end; ++t) {
    const RestTet& tet = energy.rest.tets[t];
    double F[3][3];
    displacement_gradient(tet, u, F);
    for (int r = 0; r < 3; ++r) F[r][r] += 1.0;
    SignedSvd svd(F);
    for (double& stretch : svd.s) stretch = std::max(stretch, 1.0);
    const PrincipalCurvature H = projected(material.curvature(t, svd.s), Projection::clamp);
    Eigen::Vector3d diagonal;
    for (int i = 0; i < 3; ++i)
      diagonal[i] = (H.scaling[i][i] + H.same(kPairs[i][0]) + H.same(kPairs[i][1])) / 3.0;
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> V(&svd.V[0][0]);
    const Eigen::Matrix<double, 4, 3> b = hat_gradients(tet) * V;
    locals_[t] += (weight * tet.volume) * b * diagonal.asDiagonal() * b.transpose();
  }
}

}  // namespace snapspace
