#pragma once
#include <algorithm>
#include <cstddef>
#include <vector>

#include "simd/lanes.h"
#include "simd/number_pairs.h"

namespace snapspace::online {

/// Numbers to read from which an evaluation is worth two threads: about 10 microseconds of one.
constexpr std::size_t kLeastToShare = std::size_t{1} << 16;

/// Displacement gradients of few tets as linear maps G_e (9 x d) of the reduced coordinates, and
/// forces back to coordinates. One tet per SIMD lane, a block of kWidth tets at a time.
///
/// An energy reads each G_e once from memory, which is what takes the time. Its entries are rounded
/// to 2^-21, two in a word (simd/number_pairs.h): a tiny change of the modes. All arithmetic is in
/// double, so that value and gradient belong together to full precision; in single precision line
/// searches get stuck in the noise. Takes no memory after construction.
class TetRows {
 public:
  static constexpr int kWidth = kWideLanes;
  using Tets = Lanes<kWidth>;

  /// @param rows  tets x 9 x dimension; entry 3 a + b of the second is d u_a / d x_b
  TetRows(int dimension, int tets, const float* rows);

  /// Numbers that an evaluation reads.
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(blocks()) * kWidth * 9 * pairs_;
  }
  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int capacity() const { return capacity_; }
  [[nodiscard]] int tets() const { return tets_; }
  [[nodiscard]] int blocks() const { return (tets_ + kWidth - 1) / kWidth; }
  /// Tets of a block: the last one may have lanes without.
  [[nodiscard]] int lanes(int block) const { return std::min(kWidth, tets_ - block * kWidth); }

  /// Restricts the maps to the first coordinates, 1 <= dimension <= capacity.
  void set_dimension(int dimension);

  /// Takes q (d), and forgets all forces.
  void begin(const double* q);
  /// Displacement gradients of a block's tets at q.
  void gradients(int block, Tets G[3][3]) const;
  /// First block of a half, 0 or 1; that of half 2 is where the blocks end.
  [[nodiscard]] int half_begin(int half) const { return half * blocks() / 2; }
  /// Adds the forces of a block's stresses to those of its half.
  void add_stresses(int half, int block, const Tets P[3][3]);
  /// Writes the sum of all forces (d): those of both halves.
  void end(double* gradient) const;

  /// Adds a block's part G_e^T curvature G_e to the lower triangle of `hessian` (d x d).
  void add_curvatures(int block, const Tets curvature[9][9], double* hessian) const;

 private:
  [[nodiscard]] const Tets* words(int block) const {
    return words_.data() + static_cast<std::size_t>(block) * 9 * ((capacity_ + 1) / 2);
  }
  /// One mode's displacement gradients.
  [[nodiscard]] static Tets entry(const Tets* words, int mode, int e);

  int capacity_, dimension_;
  int pairs_;  // of modes, those of the dimension
  int tets_;
  std::vector<Tets> words_;          // block, pair of modes, entry of G; an odd last mode is joined
                                     // by zeros
  std::vector<double> coordinates_;  // q, and a zero if d is odd
  std::vector<Tets> sums_;           // of forces, half by half, lane by lane
};

/// Writes the matrices (9 x 9) of the first lanes one after the other; returns where they end.
inline float* store_tets(const TetRows::Tets matrices[9][9], int lanes, float* to) {
  for (int lane = 0; lane < lanes; ++lane)
    for (int f = 0; f < 9; ++f)
      for (int e = 0; e < 9; ++e) *to++ = static_cast<float>(matrices[f][e][lane]);
  return to;
}

inline double lane_sum(const TetRows::Tets& pack) {
  double sum = 0.0;
  for (int lane = 0; lane < TetRows::kWidth; ++lane) sum += pack[lane];
  return sum;
}

}  // namespace snapspace::online
