#pragma once
#include <cstddef>
#include <span>

namespace snapspace {

/// combined(j) = sum_i weights(j, i) rows[i] for rows that are separate arrays, in memory or in
/// mapped files. Rows without a weight are not read. If all other rows are finite, a sum depends
/// neither on the other sums nor on the number of threads.
/// @param size      length of a row
/// @param weights   (combinations, rows)
/// @param combined  (combinations, size)
void combine_rows(std::span<const double* const> rows, std::size_t size, const double* weights,
                  std::size_t combinations, double* combined, int threads);

}  // namespace snapspace
