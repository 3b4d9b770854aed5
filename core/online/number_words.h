#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simd/number_pairs.h"

namespace snapspace::online {

/// Makes the words of an array's numbers, two in each.
class NumberWords {
 public:
  NumberWords(const float* numbers, std::size_t count) {
    double largest = 1e-200;
    for (std::size_t i = 0; i < count; ++i)
      largest = std::max(largest, std::abs(double{numbers[i]}));
    smallest_ = 1e-30 * largest;
  }

  /// The first of two numbers must not be zero; see number_pair.
  double operator()(double first, double second) const {
    return number_pair(std::abs(first) < smallest_ ? smallest_ : first, second);
  }

 private:
  double smallest_;
};

}  // namespace snapspace::online
