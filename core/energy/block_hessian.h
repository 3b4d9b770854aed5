#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "energy/elastic_energy.h"
#include "energy/projection.h"

namespace snapspace {

/// Symmetric matrix of 3 x 3 blocks, one per pair of vertices that share a tet, row by row.
/// The pattern and the places of each element's 16 blocks are found once; assembling again only
/// writes values.
class BlockHessian {
 public:
  explicit BlockHessian(const RestShape& rest);
  /// The same, with the pairs of vertices in a star if the energy has stars.
  explicit BlockHessian(const ElasticEnergy& energy);

  void clear();

  /// Adds weight * the Hessian of the elastic energy at displacements u, projected tet by tet.
  /// @param threshold  smallest singular value for Projection::stretches
  void add(const ElasticEnergy& energy, const double* u, Projection projection,
           double threshold = 0.0, double weight = 1.0);

  /// The same with a weight for each tet.
  void add(const ElasticEnergy& energy, const double* u, Projection projection, double threshold,
           const double* weights);

  /// Adds weight * force (x) force, for forces at the vertices of a tet.
  void add_outer_product(int tet, const double (&forces)[4][3], double weight);

  /// Adds `value` to the three diagonal entries of a vertex.
  void add_to_diagonal(int vertex, double value);

  /// product = H v, both 3n.
  void multiply(const double* v, double* product) const;

  [[nodiscard]] const std::vector<std::int32_t>& row_start() const { return row_start_; }
  [[nodiscard]] const std::vector<std::int32_t>& columns() const { return columns_; }
  [[nodiscard]] const std::vector<std::array<double, 9>>& blocks() const { return blocks_; }

 private:
  /// @param stars  null, or those whose vertices are pairs too
  BlockHessian(const RestShape& rest, const VertexStars* stars);

  void add_stars(const ElasticEnergy& energy, const double* u, Projection projection,
                 double weight);
  void add_tet(const ElasticEnergy& energy, int tet, const double* u, Projection projection,
               double threshold, double weight);
  [[nodiscard]] double* block(std::int32_t row, std::int32_t column);
  void add_shell_element(const ElasticEnergy& energy, int element, const double* u,
                         Projection projection, double weight);

  std::vector<std::int32_t> row_start_;        // n + 1
  std::vector<std::int32_t> columns_;          // one per block, ascending within a row
  std::vector<std::array<double, 9>> blocks_;  // row-major 3 x 3
  // The block of vertex pair (a, b) of a tet at 4 a + b.
  std::vector<std::array<std::int32_t, 16>> slots_;
};

}  // namespace snapspace
