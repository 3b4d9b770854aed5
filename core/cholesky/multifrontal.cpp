#include "cholesky/multifrontal.h"

#include <Eigen/Cholesky>
#include <stdexcept>
#include <string>
#include <vector>

namespace snapspace {

namespace {

using Matrix = Eigen::MatrixXd;
using Map = Eigen::Map<Matrix>;

/// Factors the first columns of a front, of which only the lower triangles are read: `panel`
/// becomes those of the factor, and `rest` what remains for the later ones. False if a pivot is not
/// positive.
bool eliminate(Map panel, Map rest) {
  Eigen::Ref<Matrix> top = panel.topRows(panel.cols());
  const Eigen::LLT<Eigen::Ref<Matrix>> llt(top);
  // a pivot that is not a number passes LLT's own test
  if (llt.info() != Eigen::Success || !(top.diagonal().minCoeff() > 0.0)) return false;
  if (rest.rows() == 0) return true;
  auto below = panel.bottomRows(rest.rows());
  top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
  rest.selfadjointView<Eigen::Lower>().rankUpdate(below, -1.0);
  return true;
}

}  // namespace

void multifrontal_cholesky(
    const Eigen::SparseMatrix<double>& A, const Supernodes& supernodes,
    const std::function<void(std::int32_t, const Eigen::Ref<const Eigen::MatrixXd>&)>& sink) {
  const std::vector<std::int32_t> places = supernodes.places();
  std::vector<std::int32_t> local(places.size()), target;
  // What finished supernodes leave to their parents. In postorder the children's are on top.
  std::vector<std::vector<double>> updates;
  std::vector<std::int32_t> owners;
  std::vector<double> columns;
  for (std::int32_t s = 0; s < supernodes.count(); ++s) {
    const std::int32_t first = supernodes.first_column[s], k = supernodes.columns(s);
    const std::int32_t below = supernodes.rows_below(s), height = k + below;
    const std::int32_t* rows = supernodes.rows.data() + supernodes.first_row[s];
    for (std::int32_t j = 0; j < k; ++j) local[first + j] = j;
    for (std::int32_t i = 0; i < below; ++i) local[rows[i]] = k + i;

    columns.assign(static_cast<std::size_t>(height) * k, 0.0);
    std::vector<double> remainder(static_cast<std::size_t>(below) * below, 0.0);
    Map panel(columns.data(), height, k), rest(remainder.data(), below, below);
    for (std::int32_t j = 0; j < k; ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(A, supernodes.order[first + j]); entry;
           ++entry)
        if (places[entry.row()] >= first + j) panel(local[places[entry.row()]], j) = entry.value();
    for (; !owners.empty() && supernodes.parent[owners.back()] == s;
         owners.pop_back(), updates.pop_back()) {
      const std::int32_t child = owners.back(), size = supernodes.rows_below(child);
      const std::int32_t* from = supernodes.rows.data() + supernodes.first_row[child];
      target.resize(size);
      for (std::int32_t i = 0; i < size; ++i) target[i] = local[from[i]];
      const double* value = updates.back().data();
      for (std::int32_t j = 0; j < size; ++j) {
        double* to = target[j] < k ? &panel(0, target[j]) : &rest(0, target[j] - k) - k;
        for (std::int32_t i = j; i < size; ++i)
          to[target[i]] += value[static_cast<std::size_t>(j) * size + i];
      }
    }
    if (!eliminate(panel, rest))
      throw std::invalid_argument("ScalarFactor: the matrix of size " + std::to_string(A.rows()) +
                                  " is not positive definite; every connected component needs a "
                                  "handle, and the stiffness and the Lame parameters must be "
                                  "positive");
    sink(s, panel);
    if (below > 0) {
      owners.push_back(s);
      updates.push_back(std::move(remainder));
    }
  }
}

}  // namespace snapspace
