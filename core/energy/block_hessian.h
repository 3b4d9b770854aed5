#pragma once
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "energy/elastic_energy.h"

namespace snapspace {

/// As a lower bound of singular values: none.
inline constexpr double kUnclamped = -std::numeric_limits<double>::infinity();

/// Symmetric matrix of 3 x 3 blocks, one per pair of vertices that share a tet, row by row.
///
/// The pattern and the place of every element's 16 blocks are found once; assembling again only
/// writes values.
class BlockHessian {
 public:
  explicit BlockHessian(const RestShape& rest);

  void clear();

  /// Adds weight * the Hessian of the elastic energy at displacements u, every element evaluated at
  /// its clamped state: of F = U diag(s) V^T, with U and V proper rotations and the sign of an
  /// inversion in the smallest s, each singular value is raised to at least `clamp` [Irving, Teran,
  /// Fedkiw 2004; paper, sec. 4.2]. Not always positive definite; with a clamp of 1 it is.
  void add(const ElasticEnergy& energy, const double* u, double clamp = kUnclamped,
           double weight = 1.0);

  /// The block of corners a and b of a tet.
  [[nodiscard]] std::array<double, 9>& block(std::size_t tet, int a, int b) {
    return blocks_[slots_[tet][4 * a + b]];
  }

  /// Adds `value` to the three diagonal entries of a vertex.
  void add_to_diagonal(int vertex, double value);

  /// product = H v, both 3n.
  void multiply(const double* v, double* product) const;

  [[nodiscard]] const std::vector<std::int32_t>& row_start() const { return row_start_; }
  [[nodiscard]] const std::vector<std::int32_t>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<std::array<double, 9>>& blocks() const { return blocks_; }

 private:
  void add_element(const StVK& material, const RestTet& tet, double volume,
                   const std::array<std::int32_t, 16>& slots, const double G[3][3]);

  std::vector<std::int32_t> row_start_;        // n + 1
  std::vector<std::int32_t> columns_;          // one per block, ascending within a row
  std::vector<std::array<double, 9>> blocks_;  // row-major 3 x 3
  // Of every tet: the block of its vertex pair (a, b) at 4 a + b.
  std::vector<std::array<std::int32_t, 16>> slots_;
};

}  // namespace snapspace
