#include "reduction/quartic_coefficients.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "online/quartic.h"
#include "reduction/gram_sum.h"
#include "reduction/strain_rows.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

constexpr int kPanelTets = 24;

/// Number of parts into which the tets are divided, each with its own sum: enough for many threads,
/// but limited by memory. It does not depend on the number of threads, because sums in another
/// order round differently.
int part_count(int columns, int tets) {
  constexpr double kMaxParts = 8.0, kMaxBytes = 256e6;  // the bytes are those of all sums
  const double each = 4.0 * columns * columns;
  const int panels = (tets + kPanelTets - 1) / kPanelTets;
  return std::clamp(static_cast<int>(std::min(kMaxParts, kMaxBytes / each)), 1,
                    std::max(1, panels));
}

/// Column of the pair (i, j), i <= j, after the constant and the d linear columns.
int pair_column(int dimension, int i, int j) { return 1 + dimension + j * (j + 1) / 2 + i; }

/// Adds the rows of the tets from `begin` to before `end`.
void add_tets(const ElasticEnergy& energy, const VertexModes& modes, int dimension, int begin,
              int end, GramSum& gram) {
  StrainRows strain(modes, dimension);
  const TetMaterial material = energy.material.view();
  for (int first = begin; first < end; first += kPanelTets) {
    const int count = std::min(kPanelTets, end - first);
    for (int t = 0; t < count; ++t) {
      strain.fill(energy.rest.tets[first + t], material.small_strains(first + t));
      for (int s = 0; s < 6; ++s) gram.set_row(6 * t + s, strain.row(s));
    }
    gram.add(6 * count);
  }
}

GramSum gram_matrix(const ElasticEnergy& energy, const double* modes, int dimension, int columns,
                    int threads) {
  const VertexModes by_vertex(modes, dimension, 3 * std::size_t(energy.rest.vertex_count));
  const int tets = static_cast<int>(energy.rest.tets.size());
  const int parts = part_count(columns, tets);
  std::vector<GramSum> sums(parts, GramSum(columns, 6 * kPanelTets));
  const auto first = [&](int part) { return static_cast<int>(std::int64_t(tets) * part / parts); };
  parallel_for(parts, threads, [&](int part) {
    add_tets(energy, by_vertex, dimension, first(part), first(part + 1), sums[part]);
  });
  for (int part = 1; part < parts; ++part) sums[0].add(sums[part]);
  return std::move(sums[0]);
}

/// Position of the monomial x_i x_j x_k x_l in online::Quartic's order; its indices are in any
/// order.
std::size_t monomial(std::array<int, 4> index) {
  std::sort(index.begin(), index.end());
  const std::size_t i = index[0], j = index[1], k = index[2], l = index[3];
  return online::quartic_count(l) + k * (k + 1) * (k + 2) / 6 + online::pair_count(j) + i;
}

}  // namespace

std::vector<double> quartic_coefficients(const ElasticEnergy& energy, const double* modes,
                                         int dimension, int threads) {
  if (energy.material.view().kind != material_index(StVK::kName))
    throw std::invalid_argument("the energy is not a polynomial of degree four: its material is " +
                                std::string(energy.material.name()));
  const int columns = 1 + dimension + static_cast<int>(online::pair_count(dimension));
  const GramSum gram = gram_matrix(energy, modes, dimension, columns, threads);
  // The factors (i, j) of x = (1, q) for each column of A.
  std::vector<std::array<int, 2>> factors(columns);
  for (int j = 0; j <= dimension; ++j)
    for (int i = 0; i <= j; ++i)
      factors[i == 0 ? j : pair_column(dimension, i - 1, j - 1)] = {i, j};

  std::vector<double> coefficients(online::quartic_count(dimension + 1), 0.0);
  for (int b = 0; b < columns; ++b)
    for (int a = 0; a <= b; ++a)
      coefficients[monomial({factors[a][0], factors[a][1], factors[b][0], factors[b][1]})] +=
          (a == b ? 1.0 : 2.0) * gram.at(a, b);
  return coefficients;
}

}  // namespace snapspace
