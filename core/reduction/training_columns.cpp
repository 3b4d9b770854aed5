#include "reduction/training_columns.h"

#include <algorithm>
#include <vector>

#include "simd/lanes.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

using Singles = SingleLanes<2 * kWideLanes>;

/// Candidates whose maps stay in the second-level cache for all states (d = 120: 138 kB).
constexpr int kCandidates = 32;
/// Numbers of candidates and of packs of directions whose sums stay in registers.
constexpr int kTileForces = 4, kTilePacks = 3;

int single_packs(int numbers) { return (numbers + Singles::kWidth - 1) / Singles::kWidth; }

/// Rows of numbers, each padded with zeros to whole packs.
class PaddedRows {
 public:
  PaddedRows(std::size_t rows, int length)
      : length_(length), packs_(single_packs(length)), data_(rows * packs_, Singles(0.0f)) {}

  [[nodiscard]] int packs() const { return packs_; }
  Singles* at(std::size_t row) { return data_.data() + row * packs_; }
  const Singles* at(std::size_t row) const { return data_.data() + row * packs_; }
  [[nodiscard]] const float* numbers(std::size_t row) const {
    return reinterpret_cast<const float*>(at(row));
  }
  void copy(std::size_t first, std::size_t count, const float* from) {
    for (std::size_t row = first; row < first + count; ++row, from += length_)
      std::copy_n(from, length_, reinterpret_cast<float*>(at(row)));
  }

 private:
  int length_, packs_;
  std::vector<Singles> data_;
};

/// The reduced force of one tet: sum_e stress[e] rows[e].
void force(const PaddedRows& rows, int tet, int numbers, const float* stress, Singles* result) {
  const Singles* map = rows.at(static_cast<std::size_t>(numbers) * tet);
  const int packs = rows.packs();
  for (int p = 0; p < packs; ++p) {
    Singles sum(0.0f);
    for (int e = 0; e < numbers; ++e) sum += Singles(stress[e]) * map[e * packs + p];
    result[p] = sum;
  }
}

/// Products of the forces of kTileForces tets, from the first on, with `TilePacks` packs of
/// directions.
template <int TilePacks>
void multiply(int dimension, const PaddedRows& forces, int first, const Singles* along, int stride,
              PaddedRows& products, int pack) {
  Singles sums[kTileForces][TilePacks];
#pragma GCC unroll 4
  for (auto& row : sums)
#pragma GCC unroll 3
    for (Singles& sum : row) sum = Singles(0.0f);
  const float* force[kTileForces];
  for (int c = 0; c < kTileForces; ++c) force[c] = forces.numbers(first + c);
  for (int i = 0; i < dimension; ++i, along += stride) {
    Singles direction[TilePacks];
#pragma GCC unroll 3
    for (int p = 0; p < TilePacks; ++p) direction[p] = along[p];
#pragma GCC unroll 4
    for (int c = 0; c < kTileForces; ++c) {
      const Singles factor(force[c][i]);
#pragma GCC unroll 3
      for (int p = 0; p < TilePacks; ++p) sums[c][p] += factor * direction[p];
    }
  }
  for (int c = 0; c < kTileForces; ++c)
    for (int p = 0; p < TilePacks; ++p) products.at(first + c)[pack + p] = sums[c][p];
}

/// Products of all forces with the directions of a state.
void multiply(int dimension, const PaddedRows& forces, const PaddedRows& along, int state,
              PaddedRows& products) {
  const int packs = along.packs();
  const Singles* directions = along.at(static_cast<std::size_t>(state) * dimension);
  for (int first = 0; first < kCandidates; first += kTileForces) {
    int p = 0;
    for (; p + kTilePacks <= packs; p += kTilePacks)
      multiply<kTilePacks>(dimension, forces, first, directions + p, packs, products, p);
    if (packs - p == 2) multiply<2>(dimension, forces, first, directions + p, packs, products, p);
    if (packs - p == 1) multiply<1>(dimension, forces, first, directions + p, packs, products, p);
  }
}

}  // namespace

void training_columns(int dimension, int candidates, const float* rows,
                      const TrainingStates& states, int threads, std::size_t stride,
                      float* columns) {
  PaddedRows along(static_cast<std::size_t>(states.count) * dimension, states.directions);
  along.copy(0, static_cast<std::size_t>(states.count) * dimension, states.along);
  const auto numbers = static_cast<std::size_t>(states.numbers);
  parallel_for((candidates + kCandidates - 1) / kCandidates, threads, [&](int group) {
    const int begin = group * kCandidates, count = std::min(kCandidates, candidates - begin);
    PaddedRows maps(numbers * kCandidates, dimension), forces(kCandidates, dimension),
        products(kCandidates, states.directions);
    maps.copy(0, numbers * count, rows + numbers * begin * dimension);
    for (int s = 0; s < states.count; ++s) {
      const float* stress =
          states.stresses + numbers * (static_cast<std::size_t>(s) * candidates + begin);
      for (int c = 0; c < count; ++c)
        force(maps, c, states.numbers, stress + numbers * c, forces.at(c));
      multiply(dimension, forces, along, s, products);
      for (int c = 0; c < count; ++c)
        std::copy_n(
            products.numbers(c), states.directions,
            columns + (begin + c) * stride + static_cast<std::size_t>(s) * states.directions);
    }
  });
}

}  // namespace snapspace
