#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>

#include "cholesky/supernodes.h"

namespace snapspace {

/// The Cholesky factor of A, supernode by supernode [Duff & Reid 1983; Liu 1992]: `panel` is
/// called with each one's dense columns, its own triangle above the rows below it.
///
/// @throws std::invalid_argument if A is not positive definite
void multifrontal_cholesky(
    const Eigen::SparseMatrix<double>& A, const Supernodes& supernodes,
    const std::function<void(std::int32_t, const Eigen::Ref<const Eigen::MatrixXd>&)>& panel);

}  // namespace snapspace
