#pragma once
#include <algorithm>
#include <cstddef>

#include "online/packed_layout.h"
#include "simd/memory.h"

namespace snapspace::online {

/// A window of it is a mask of the first lanes of a pack.
template <int Width>
struct FirstLanes {
  double ones[2 * Width] = {};
  constexpr FirstLanes() {
    for (int i = 0; i < Width; ++i) ones[i] = 1.0;
  }
};
template <int Width>
inline constexpr FirstLanes<Width> kFirstLanes;

/// Gradients of the forms sum_{i <= j <= a} form_ij x_i x_j, i fastest, for a = first ... last - 1.
///
/// Row j of a form, i <= j, adds row * x_j to entries i of the gradient, and row . x to entry j.
/// Row j of all forms comes before row j + 1 of any: loops of one length after each other are
/// predicted.
/// @param form       form(a) is the address of a form; Width numbers behind it are read, too
/// @param x          `last` numbers, then zeros up to a multiple of 8
/// @param stride     of the gradients, a multiple of 8, at least `last`
/// @param gradients  gradients[a * stride + i], i <= a; what is behind is spoilt
template <int Width, class Form>
inline void form_gradients(Form&& form, int first, int last, const double* x, std::size_t stride,
                           double* gradients) {
  for (int a = first; a < last; ++a)
    std::fill_n(gradients + a * stride, PackedLayout::padded(a + 1), 0.0);
  for (int j = 0; j < last; ++j) {
    const Lanes<Width> x_j(x[j]);
    const int tail = j / Width * Width;
    const Lanes<Width> mask = load<Width>(kFirstLanes<Width>.ones + Width - 1 - (j - tail));
    const Lanes<Width> x_tail = load<Width>(x + tail);
    const auto row_of = [&](int a) {
      const double* row = form(a) + pair_count(j);
      double* gradient = gradients + a * stride;
      Lanes<Width> dot(0.0);
      for (int i = 0; i < tail; i += Width) {
        const Lanes<Width> entries = load<Width>(row + i);
        dot += entries * load<Width>(x + i);
        store(gradient + i, load<Width>(gradient + i) + entries * x_j);
      }
      // lanes beyond the diagonal belong to the next row
      const Lanes<Width> entries = select(mask, load<Width>(row + tail), Lanes<Width>(0.0));
      store(gradient + tail, load<Width>(gradient + tail) + entries * x_j);
      return dot + entries * x_tail;
    };
    int a = std::max(first, j);
    for (; a + 4 <= last; a += 4) {
      const Lanes<Width> sums[4] = {row_of(a), row_of(a + 1), row_of(a + 2), row_of(a + 3)};
      double dots[4];
      lane_sums<4>(sums, dots);
      for (int i = 0; i < 4; ++i) gradients[(a + i) * stride + j] += dots[i];
    }
    for (; a < last; ++a) {
      const Lanes<Width> sum = row_of(a);
      double dot;
      lane_sums<1>(&sum, &dot);
      gradients[a * stride + j] += dot;
    }
  }
}

}  // namespace snapspace::online
