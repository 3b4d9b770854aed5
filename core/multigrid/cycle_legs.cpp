// The legs of the cycle, for packs of every width.
#include "multigrid/two_grid_cycle.h"

namespace snapspace {

template <class Real>
void TwoGridCycle::subtract(const Link* link, const Link* end, const Real* x, Point<Real>& y) {
  const auto point = [&](std::int32_t v) { return Point<Real>::at(x + 3 * std::size_t(v)); };
  auto odd = Point<Real>::zero();
  for (; link + 1 < end; link += 2) {
    y.subtract(link[0].weight, point(link[0].vertex));
    odd.subtract(link[1].weight, point(link[1].vertex));
  }
  if (link < end) y.subtract(link->weight, point(link->vertex));
  y.add(odd);
}

/// Starts from x = 0, so later neighbours do not count yet.
template <class Real>
void TwoGridCycle::sweep_down(std::int32_t i, const Real* b, Real* x) const {
  Point<Real> y = scaled(b, i);
  subtract(links_.data() + rows_[i].links, links_.data() + rows_[i].later, x, y);
  y.store(x + 3 * std::size_t(i));
}

/// The equation held when the sweep passed; only later neighbours have changed since.
template <class Real>
void TwoGridCycle::restrict_residual(std::int32_t i, const Real* x, Real* coarse) const {
  auto residual = Point<Real>::zero();  // over a_ii
  subtract(links_.data() + rows_[i].later, links_.data() + rows_[i + 1].links, x, residual);
  const float diagonal = 1.0f / inverse_diagonal_[i];
  for (std::int32_t k = rows_[i].parents; k < rows_[i + 1].parents; ++k) {
    Real* entries = coarse + 3 * std::size_t(parents_[k].vertex);
    auto sum = Point<Real>::at(entries);
    sum.subtract(-diagonal * parents_[k].weight, residual);
    sum.store(entries);
  }
}

template <class Real>
void TwoGridCycle::prolong(std::int32_t i, const Real* coarse, Real* x) const {
  auto y = Point<Real>::at(x + 3 * std::size_t(i));
  for (std::int32_t k = rows_[i].parents; k < rows_[i + 1].parents; ++k)
    y.subtract(-parents_[k].weight, Point<Real>::at(coarse + 3 * std::size_t(parents_[k].vertex)));
  y.store(x + 3 * std::size_t(i));
}

template <class Real>
Sum<Real> TwoGridCycle::sweep_up(std::int32_t i, const Real* b, Real* x, Real* solution) const {
  Point<Real> y = scaled(b, i);
  subtract(links_.data() + rows_[i].links, links_.data() + rows_[i + 1].links, x, y);
  const std::size_t at = 3 * std::size_t(i);
  y.store(x + at);
  Real product(0);  // one vertex only, so the precision of the entries suffices
  for (int c = 0; c < 3; ++c) product += b[at + c] * x[at + c];
  y.store(solution + at);  // may be b's memory
  return widened(product);
}

// The two parts of a leg follow each other through the mesh, one front of its numbering apart: a
// vertex is still in a cache when the second part reaches it.

template <class Real>
void TwoGridCycle::descend(const Real* b, Real* x, Real* coarse) const {
  const auto n = static_cast<std::int32_t>(size());
  for (std::int32_t swept = 0, restricted = 0; restricted < n;) {
    for (const std::int32_t end = std::min(n, swept + kRows); swept < end; ++swept)
      sweep_down(swept, b, x);
    for (; restricted < n && last_[restricted] < swept; ++restricted)
      restrict_residual(restricted, x, coarse);
  }
}

template <class Real>
Sum<Real> TwoGridCycle::ascend(const Real* coarse, const Real* b, Real* x, Real* solution) const {
  Sum<Real> product(0.0);
  for (auto swept = static_cast<std::int32_t>(size()), prolonged = swept; swept > 0;) {
    for (const std::int32_t end = std::max(0, prolonged - kRows); prolonged > end;)
      prolong(--prolonged, coarse, x);
    while (swept > 0 && first_[swept - 1] >= prolonged)
      product += sweep_up(--swept, b, x, solution);
  }
  return product;
}

template <class Real>
Sum<Real> TwoGridCycle::apply(const Real* right_hand_side, Real* solution, Scratch& scratch) const {
  Real* x = scratch.array<Real>(3 * (size() + coarse_size()));
  Real* coarse = x + 3 * size();
  std::fill_n(coarse, 3 * coarse_size(), Real(0));
  descend(right_hand_side, x, coarse);
  coarse_.solve(coarse, coarse);
  return ascend(coarse, right_hand_side, x, solution);
}

#define SNAPSPACE_DEFINED(Real) \
  template Sum<Real> TwoGridCycle::apply(const Real*, Real*, Scratch&) const;
SNAPSPACE_PACKS(SNAPSPACE_DEFINED)
#undef SNAPSPACE_DEFINED

}  // namespace snapspace
