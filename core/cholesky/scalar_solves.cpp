// The triangular solves, for packs of every width.
#include <type_traits>

#include "cholesky/column_block.h"
#include "cholesky/point.h"
#include "cholesky/scalar_factor.h"

namespace snapspace {

namespace {

/// Calls visit with the number of columns as a compile-time constant.
template <int Most = kColumnBlock, class Visit>
void with_columns(int columns, Visit visit) {
  if constexpr (Most > 1)
    if (columns < Most) return with_columns<Most - 1>(columns, visit);
  visit(std::integral_constant<int, Most>{});
}

}  // namespace

// The loops over columns are unrolled: otherwise compilers keep the unknowns in memory instead of
// registers, and small blocks spend more time on their triangles than on the rows below.

template <int Columns, class Real>
void ScalarFactor::forward(const Block& block, const Scalar<Real>* l, const std::int32_t* vertices,
                           Real* all) {
  const auto entries_of = [&](std::int32_t vertex) { return all + 3 * std::size_t(vertex); };
  Point<Real> x[Columns];
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) x[j] = Point<Real>::at(entries_of(vertices[j]));
  l += Columns;
#pragma GCC unroll 8
  for (int j = 1; j < Columns; ++j)
#pragma GCC unroll 8
    for (int i = 0; i < j; ++i) x[j].subtract(l[j * (j - 1) / 2 + i], x[i]);
  l += Columns * (Columns - 1) / 2;
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) x[j].store(entries_of(vertices[j]));
  vertices += Columns;
  for (int row = 0; row < block.below; ++row, l += Columns) {
    prefetch_row(all, vertices, row, block.below);
    Real* entries = entries_of(vertices[row]);
    Point<Real> y = Point<Real>::at(entries);
    if constexpr (Columns > 4) {
      // two sums, because a product takes four cycles and two can begin in each cycle
      Point<Real> odd = Point<Real>::zero();
#pragma GCC unroll 8
      for (int j = 0; j < Columns; ++j) (j % 2 ? odd : y).subtract(l[j], x[j]);
      y.add(odd);
    } else {
#pragma GCC unroll 8
      for (int j = 0; j < Columns; ++j) y.subtract(l[j], x[j]);
    }
    y.store(entries);
  }
}

template <int Columns, class Real>
Sum<Real> ScalarFactor::backward(const Block& block, const Scalar<Real>* l,
                                 const std::int32_t* vertices, Real* all) {
  const auto entries_of = [&](std::int32_t vertex) { return all + 3 * std::size_t(vertex); };
  Point<Real> x[Columns];
  Real product(0);  // a few vertices only, so the precision of the entries suffices
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) {
    Real* entries = entries_of(vertices[j]);
    for (int c = 0; c < 3; ++c) {
      const Real w = entries[c];
      entries[c] = Real(l[j]) * w;
      product += w * entries[c];
    }
    x[j] = Point<Real>::at(entries);
  }
  l += Columns;
  const Scalar<Real>* row_entries = l + Columns * (Columns - 1) / 2;
  for (int row = 0; row < block.below; ++row, row_entries += Columns) {
    prefetch_row(all, vertices + Columns, row, block.below);
    const auto y = Point<Real>::at(entries_of(vertices[Columns + row]));
#pragma GCC unroll 8
    for (int j = 0; j < Columns; ++j) x[j].subtract(row_entries[j], y);
  }
#pragma GCC unroll 8
  for (int j = Columns - 1; j > 0; --j)
#pragma GCC unroll 8
    for (int i = 0; i < j; ++i) x[i].subtract(l[j * (j - 1) / 2 + i], x[j]);
#pragma GCC unroll 8
  for (int j = 0; j < Columns; ++j) x[j].store(entries_of(vertices[j]));
  return widened(product);
}

template <class Real>
Sum<Real> ScalarFactor::solve(const Real* right_hand_side, Real* solution) const {
  if (solution != right_hand_side) std::copy_n(right_hand_side, 3 * size_, solution);
  const Scalar<Real>* values = entries<Real>();
  const auto count = static_cast<std::ptrdiff_t>(blocks_.size());
  for (std::ptrdiff_t b = 0; b < count; ++b) {
    if (b + kBlocksAhead < count) prefetch_columns(blocks_[b + kBlocksAhead], solution);
    const Block& block = blocks_[b];
    with_columns(block.columns, [&](auto columns) {
      forward<columns()>(block, values + block.values, vertices_.data() + block.vertices, solution);
    });
  }
  Sum<Real> product(0.0);
  for (std::ptrdiff_t b = count - 1; b >= 0; --b) {
    if (b >= kBlocksAhead) {
      const Block& soon = blocks_[b - kBlocksAhead];
      prefetch_columns(soon, solution);
      prefetch(vertices_.data() + soon.vertices,
               static_cast<std::size_t>(soon.columns + soon.below));
      prefetch(values + soon.values, static_cast<std::size_t>((&soon)[1].values - soon.values));
    }
    const Block& block = blocks_[b];
    with_columns(block.columns, [&](auto columns) {
      product += backward<columns()>(block, values + block.values,
                                     vertices_.data() + block.vertices, solution);
    });
  }
  return product;
}

#define SNAPSPACE_DEFINED(Real) template Sum<Real> ScalarFactor::solve(const Real*, Real*) const;
SNAPSPACE_PACKS(SNAPSPACE_DEFINED)
#undef SNAPSPACE_DEFINED

}  // namespace snapspace
