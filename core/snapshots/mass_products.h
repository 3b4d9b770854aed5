#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace snapspace {

/// A scalar matrix (n, n), row by row.
struct ScalarRows {
  std::size_t size;
  const std::int32_t* starts;  // (n + 1,)
  const std::int32_t* columns;
  const double* values;
};

/// Inner products of displacements (3n,) with respect to a mass matrix. The displacements are
/// separate arrays, in memory or in mapped files.
class MassProducts {
 public:
  using Rows = std::span<const double* const>;

  /// @param mass  not copied
  explicit MassProducts(const ScalarRows& mass);
  ~MassProducts();

  /// products(i, j) = (rows[i] + offset)^T (M (x) I3) others[j].
  /// M times the others is formed for eight of them together, because their points are read in the
  /// order of the mesh's edges, which caches cannot predict. The products are then summed over
  /// blocks of vertices, with those of four rows by three others in registers. A product depends
  /// neither on the other rows of the call nor on the threads: its terms are always added in the
  /// same order.
  ///
  /// @param offset    (3n,), or null for none
  /// @param others    a few dozen: M times all of them is kept in memory, which the next call
  ///                  reuses
  /// @param threads   0 for all
  /// @param products  (rows, others)
  void multiply(Rows rows, const double* offset, Rows others, int threads, double* products);

 private:
  class Blocks;
  std::unique_ptr<Blocks> blocks_;  // hidden: their size depends on the width of packs
};

}  // namespace snapspace
