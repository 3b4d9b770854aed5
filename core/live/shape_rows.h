#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace snapspace::live {

/// Shapes tau + sum_i q_i mode_i of one basis for display, as fast as memory delivers the basis.
/// Modes are stored in blocks of coordinates, in the order of reading. The first modes, which carry
/// most of a displacement, are in single precision. An entry of the others takes 16 bits: it counts
/// units of the mode in the block, 1/32767 of the largest entry there, and is off by at most half a
/// unit. So a coordinate is off by at most sum_i |q_i| unit_i / 2 over the modes after the first
/// kFine, plus (d + 4) 2^-24 sum_i |q_i mode_i| and its own rounding. On bodies this is less than
/// 2e-5 of the largest displacement. The result does not depend on the number of threads.
class ShapeRows {
 public:
  /// How many modes are in single precision.
  static constexpr int kFine = 16;

  /// Copies its arrays.
  /// @param modes  dimension x size, row-major
  ShapeRows(std::size_t size, int dimension, const double* tau, const double* modes);

  [[nodiscard]] std::size_t size() const { return tau_.size(); }
  [[nodiscard]] int dimension() const { return fine_count_ + coarse_count_; }
  /// Bytes that are read for a shape of all modes.
  [[nodiscard]] std::size_t bytes() const {
    return fine_.size() * sizeof(float) + coarse_.size() * sizeof(std::int16_t) +
           units_.size() * sizeof(float) + tau_.size() * sizeof(double);
  }

  /// Writes the shape (size) of the first coordinates, `count` <= dimension.
  /// @param threads  0: as many as are worthwhile
  void shape(const double* q, int count, int threads, float* shape) const;

 private:
  void take_block(std::size_t begin, const double* modes);
  void write_block(std::size_t begin, const double* q, int count, float* shape) const;
  void add_coarse(std::size_t begin, const double* q, int count, float* sums) const;

  int fine_count_, coarse_count_;  // numbers of modes
  std::vector<double> tau_;
  std::vector<float> fine_;           // block, mode, coordinate
  std::vector<std::int16_t> coarse_;  // the same for the later modes, in units
  std::vector<float> units_;          // block, later mode
};

}  // namespace snapspace::live
