#pragma once
#include <cstddef>
#include <vector>

namespace snapspace::live {

/// Shapes tau + sum_i q_i mode_i of one basis, as fast as the memory delivers it.
///
/// Modes are kept in single precision, block by block of coordinates in the order of reading. With
/// d modes a displacement is off by at most (d + 4) 2^-24 sum_i |q_i mode_i|: on bodies by less
/// than 1e-6 of its largest entry. The shape is rounded once more. The result does not depend on
/// the number of threads.
class ShapeRows {
 public:
  /// Copies its arrays.
  /// @param modes  dimension x size, row-major
  ShapeRows(std::size_t size, int dimension, const double* tau, const double* modes);

  [[nodiscard]] std::size_t size() const { return tau_.size(); }
  [[nodiscard]] int dimension() const { return dimension_; }
  /// Bytes that a shape of all modes reads.
  [[nodiscard]] std::size_t bytes() const {
    return rows_.size() * sizeof(float) + tau_.size() * sizeof(double);
  }

  /// Writes the shape (size) of the first coordinates, `count` <= dimension.
  /// @param threads  0 for as many as pay
  void shape(const double* q, int count, int threads, float* shape) const;

 private:
  void block(std::size_t begin, const double* q, int count, float* shape) const;

  int dimension_;
  std::vector<double> tau_;
  std::vector<float> rows_;  // block, mode, coordinate
};

}  // namespace snapspace::live
