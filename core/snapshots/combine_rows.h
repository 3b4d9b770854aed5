#pragma once
#include <cstddef>
#include <span>

namespace snapspace {

/// combined(j) = sum_i weights(j, i) rows[i] for rows that are arrays of their own, in memory or in
/// mapped files. Weights that are zero cost nothing, and a sum does not depend on the others.
///
/// @param size      of a row
/// @param weights   (combinations, rows)
/// @param combined  (combinations, size)
void combine_rows(std::span<const double* const> rows, std::size_t size, const double* weights,
                  std::size_t combinations, double* combined);

}  // namespace snapspace
