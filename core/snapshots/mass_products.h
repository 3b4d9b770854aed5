#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"

namespace snapspace {

/// A scalar matrix (n, n), row by row.
struct ScalarRows {
  std::size_t size;
  const std::int32_t* starts;  // (n + 1,)
  const std::int32_t* columns;
  const double* values;
};

/// Products of displacements (3n,) with a mass matrix in between. The displacements are arrays of
/// their own, in memory or in mapped files.
class MassProducts {
 public:
  using Rows = std::span<const double* const>;

  /// @param mass  not copied
  explicit MassProducts(const ScalarRows& mass) : mass_(mass) {}

  /// products(i, j) = (rows[i] + offset)^T (M (x) I3) others[j].
  ///
  /// M times the others is formed for eight of them together, since their points are read in the
  /// order of the mesh's edges, which caches do not foresee. Then vertices go by in blocks, and
  /// four rows by three others stay in registers. A product does not depend on the other rows of
  /// the call nor on the threads: the order of its sums is always the same.
  ///
  /// @param offset    (3n,), or null for none
  /// @param others    some tens: M times all of them is kept, and the memory for the next call
  /// @param threads   0 for all
  /// @param products  (rows, others)
  void multiply(Rows rows, const double* offset, Rows others, int threads, double* products);

 private:
  using Wide = Lanes<kWideLanes>;
  static constexpr std::size_t kTogether = 8;
  using Together = Lanes<kTogether>;

  /// Blocks of four rows and of three others are 21 KB: the first-level cache holds them.
  static constexpr std::size_t kVertices = 128;
  static constexpr std::size_t kPacks = 3 * kVertices / kWideLanes;
  static constexpr std::size_t kHeight = 4, kBreadth = 3;
  /// Vertices of one thread's part of M times the others.
  static constexpr std::size_t kRange = 8 * kVertices;
  /// Rows of one thread's part: for each part the others are read once more.
  static constexpr std::size_t kPart = 8 * kHeight;

  /// Some vertices' part of one row, with zeros beyond the last vertex.
  struct Block {
    Wide packs[kPacks];
    double* numbers() { return reinterpret_cast<double*>(packs); }
  };

  void weigh(Rows others, int threads);
  void interleave(Rows group, std::size_t begin, std::size_t end);
  void weigh(std::size_t first, std::size_t count, std::size_t begin, std::size_t end);
  static void copy(const double* row, const double* offset, std::size_t first, std::size_t last,
                   Block& block);
  static void add_tile(const Block* rows, const Block* others, std::size_t height,
                       std::size_t breadth, double* products, std::size_t stride);

  ScalarRows mass_;
  std::size_t breadth_ = 0;          // of the others, with some that hold anything at the end
  StreamedVector<Block> weighted_;   // M times the others: by vertices, then by others
  StreamedVector<Together> points_;  // of eight of the others
};

}  // namespace snapspace
