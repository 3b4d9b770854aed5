#pragma once
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "simd/lanes.h"
#include "simd/number_pairs.h"

namespace snapspace::online {

/// Evaluations that read at least this many numbers are worth two threads: about 10 microseconds on
/// one.
constexpr std::size_t kMinSharedSize = std::size_t{1} << 16;

/// The linear maps G_e (9 x d) from reduced coordinates to the displacement gradients of few tets,
/// and their transposes from stresses to reduced forces. One tet per SIMD lane, a block of kWidth
/// tets at a time.
/// An energy reads each G_e once from memory, which takes most of the time. So entries are rounded
/// to 2^-21, two in a word (simd/number_pairs.h): a tiny change of the modes. All arithmetic is in
/// double precision, so that value and gradient match to full precision; in single precision line
/// searches get stuck in noise. Allocates no memory after construction.
class TetRows {
 public:
  static constexpr int kWidth = kWideLanes;
  using Tets = Lanes<kWidth>;

  /// @param rows  tets x 9 x dimension; entry 3 a + b of the second index is d u_a / d x_b
  TetRows(int dimension, int tets, const float* rows);

  /// How many words an evaluation reads.
  [[nodiscard]] std::size_t size() const { return active_.size() * kWidth * 9 * pairs_; }
  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int capacity() const { return capacity_; }
  [[nodiscard]] int tets() const { return tets_; }
  [[nodiscard]] int blocks() const { return (tets_ + kWidth - 1) / kWidth; }
  /// Number of tets in a block; the last block may have unused lanes.
  [[nodiscard]] int lanes(int block) const { return std::min(kWidth, tets_ - block * kWidth); }

  /// Restricts evaluations to the blocks for which active(block) holds; initially to all.
  template <class Active>
  void set_active(Active active) {
    active_.clear();
    for (int block = 0; block < blocks(); ++block)
      if (active(block)) active_.push_back(block);
  }

  /// Restricts the maps to the first coordinates, 1 <= dimension <= capacity.
  void set_dimension(int dimension);

  /// Sets q (d), and resets all forces to zero.
  void begin(const double* q);
  /// Displacement gradients of a block's tets at q.
  void gradients(int block, Tets G[3][3]) const;
  /// The blocks of a half, 0 or 1, of the evaluation.
  [[nodiscard]] std::span<const int> half(int half) const {
    const std::size_t middle = active_.size() / 2;
    return half == 0 ? std::span(active_).first(middle) : std::span(active_).subspan(middle);
  }
  /// Adds the forces of a block's stresses to those of its half.
  void add_stresses(int half, int block, const Tets P[3][3]);
  /// Writes the sum of all forces (d), of both halves.
  void end(double* gradient) const;

  /// Adds a block's part G_e^T curvature G_e to the lower triangle of `hessian` (d x d).
  void add_curvatures(int block, const Tets curvature[9][9], double* hessian) const;

 private:
  [[nodiscard]] const Tets* words(int block) const {
    return words_.data() + static_cast<std::size_t>(block) * 9 * ((capacity_ + 1) / 2);
  }
  int capacity_, dimension_;
  int pairs_;  // of modes, for the current dimension
  int tets_;
  std::vector<int> active_;  // blocks, ascending
  std::vector<Tets>
      words_;  // block, pair of modes, entry of G; an odd last mode is paired with zeros
  std::vector<double> coordinates_;  // q, and a zero if d is odd
  std::vector<Tets> sums_;           // of forces, half by half
};

inline double lane_sum(const TetRows::Tets& pack) {
  double sum = 0.0;
  for (int lane = 0; lane < TetRows::kWidth; ++lane) sum += pack[lane];
  return sum;
}

}  // namespace snapspace::online
