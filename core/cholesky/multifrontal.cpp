#include "cholesky/multifrontal.h"

#include <Eigen/Cholesky>
#include <utility>
#include <vector>

namespace snapspace {

namespace {

using Matrix = Eigen::MatrixXd;

/// A supernode's columns, and their update of the rows below. Only lower triangles count.
struct Front {
  Matrix panel, rest;

  Front(Eigen::Index columns, Eigen::Index below)
      : panel(Matrix::Zero(columns + below, columns)), rest(Matrix::Zero(below, below)) {}

  /// Adds the update of a child. `places` are those of its rows in this front, ascending.
  void add(const Matrix& left, const std::vector<std::int32_t>& places) {
    const Eigen::Index columns = panel.cols();
    for (Eigen::Index j = 0; j < left.cols(); ++j)
      if (places[j] < columns) {
        for (Eigen::Index i = j; i < left.rows(); ++i) panel(places[i], places[j]) += left(i, j);
      } else {
        for (Eigen::Index i = j; i < left.rows(); ++i)
          rest(places[i] - columns, places[j] - columns) += left(i, j);
      }
  }

  /// Replaces the panel by that of the factor. Returns false if a pivot is not positive.
  bool eliminate() {
    Eigen::Ref<Matrix> top = panel.topRows(panel.cols());
    const Eigen::LLT<Eigen::Ref<Matrix>> llt(top);
    // a NaN pivot passes LLT's own test
    if (llt.info() != Eigen::Success || !(top.diagonal().array() > 0.0).all()) return false;
    if (rest.rows() == 0) return true;
    auto below = panel.bottomRows(rest.rows());
    top.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(below);
    rest.selfadjointView<Eigen::Lower>().rankUpdate(below, -1.0);
    return true;
  }
};

}  // namespace

bool multifrontal_cholesky(const Eigen::SparseMatrix<double>& A, const Supernodes& supernodes,
                           const PanelSink& sink) {
  const std::vector<std::int32_t> columns = supernodes.places();
  std::vector<std::int32_t> place(columns.size());  // place of each row in the current front
  // Updates of the supernodes whose parent is still to come; the children of the next one are last.
  std::vector<std::pair<std::int32_t, Matrix>> waiting;
  std::vector<std::int32_t> places;
  for (std::int32_t s = 0; s < supernodes.count(); ++s) {
    const std::int32_t first = supernodes.first_column[s], own = supernodes.columns(s);
    const auto below = supernodes.below(s);
    for (std::int32_t j = 0; j < own; ++j) place[first + j] = j;
    for (std::size_t i = 0; i < below.size(); ++i) place[below[i]] = own + static_cast<int>(i);

    Front front(own, static_cast<Eigen::Index>(below.size()));
    for (std::int32_t j = 0; j < own; ++j)
      for (Eigen::SparseMatrix<double>::InnerIterator entry(A, supernodes.order[first + j]); entry;
           ++entry)
        if (const std::int32_t row = columns[entry.row()]; row >= first + j)
          front.panel(place[row], j) = entry.value();
    for (; !waiting.empty() && supernodes.parent[waiting.back().first] == s; waiting.pop_back()) {
      const auto& [child, left] = waiting.back();
      places.clear();
      for (const std::int32_t row : supernodes.below(child)) places.push_back(place[row]);
      front.add(left, places);
    }
    if (!front.eliminate()) return false;
    sink(s, front.panel);
    if (!below.empty()) waiting.emplace_back(s, std::move(front.rest));
  }
  return true;
}

}  // namespace snapspace
