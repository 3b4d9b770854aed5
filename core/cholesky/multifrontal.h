#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>

#include "cholesky/supernodes.h"

namespace snapspace {

/// Receives the dense columns of a supernode: its own triangle, where only the lower half counts,
/// followed by the rows below it.
using PanelSink = std::function<void(std::int32_t, const Eigen::MatrixXd&)>;

/// The Cholesky factor of A, supernode by supernode [Duff & Reid 1983; Liu 1992].
///
/// @param A           both triangles stored
/// @param supernodes  of A, or of a matrix whose pattern contains A's
/// @return false if A is not positive definite; the factor is then incomplete
[[nodiscard]] bool multifrontal_cholesky(const Eigen::SparseMatrix<double>& A,
                                         const Supernodes& supernodes, const PanelSink& sink);

}  // namespace snapspace
