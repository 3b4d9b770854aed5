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

/// Products of displacements (3n,) with a mass matrix in between. The displacements are arrays of
/// their own, in memory or in mapped files.
class MassProducts {
 public:
  using Rows = std::span<const double* const>;

  /// @param mass  not copied
  explicit MassProducts(const ScalarRows& mass);
  ~MassProducts();

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
  class Blocks;
  std::unique_ptr<Blocks> blocks_;  // their size depends on the width of packs
};

}  // namespace snapspace
