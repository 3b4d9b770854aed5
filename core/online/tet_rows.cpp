#include "online/tet_rows.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "online/number_words.h"
#include "simd/vectors.h"

namespace snapspace::online {

namespace {

constexpr std::size_t pairs_of(int count) { return (static_cast<std::size_t>(count) + 1) / 2; }

/// Writes the words of some tets (tets x 9 x rank), blocks x pairs x 9.
void fill_words(int tets, int rank, const float* rows, const NumberWords& word,
                TetRows::Tets* words) {
  constexpr int kWidth = TetRows::kWidth;
  const std::size_t pairs = pairs_of(rank);
  for (int tet = 0; tet < tets; ++tet)
    for (std::size_t pair = 0; pair < pairs; ++pair)
      for (int e = 0; e < 9; ++e) {
        const float* row = rows + (static_cast<std::size_t>(tet) * 9 + e) * rank + 2 * pair;
        const double second = 2 * static_cast<int>(pair) + 1 < rank ? row[1] : 0.0f;
        words[(tet / kWidth * pairs + pair) * 9 + e].set(tet % kWidth, word(row[0], second));
      }
}

/// Writes some entries of each lane, lane after lane; returns the place after them.
template <int Count>
float* store_lanes(int lanes, const TetRows::Tets* entries, float* to) {
  for (int lane = 0; lane < lanes; ++lane)
    for (int e = 0; e < Count; ++e) *to++ = static_cast<float>(entries[e][lane]);
  return to;
}

}  // namespace

TetRows::TetRows(int dimension, int tets, const float* rows, const RowClusters& clusters)
    : capacity_(dimension),
      dimension_(dimension),
      pairs_((dimension + 1) / 2),
      tets_(tets),
      all_(blocks()),
      clusters_(std::max(clusters.count, 1)),
      coordinates_(2 * static_cast<std::size_t>(pairs_)) {
  std::iota(all_.begin(), all_.end(), 0);
  active_ = all_;
  const int whole[2] = {tets, dimension};
  const int* sizes = clusters.count > 0 ? clusters.sizes : whole;
  const float* modes = clusters.modes;
  std::size_t numbers = 0, words = 0;
  int first = 0;
  for (Cluster& cluster : clusters_) {
    const int own = *sizes++, rank = *sizes++;
    cluster.first = first;
    cluster.end = first += (own + kWidth - 1) / kWidth;
    cluster.rank = rank;
    cluster.pairs = cluster.stride = static_cast<int>(pairs_of(rank));
    cluster.words = words;
    if (clusters.count > 0) cluster.modes = LocalModes(dimension, rank, modes);
    if (clusters.count > 0) modes += static_cast<std::size_t>(rank) * dimension;
    numbers += static_cast<std::size_t>(own) * 9 * rank;
    words += static_cast<std::size_t>(cluster.end - cluster.first) * 9 * cluster.stride;
  }
  const NumberWords word(rows, numbers);
  words_.assign(words, Tets(word(0.0, 0.0)));
  for (const Cluster& cluster : clusters_) {
    const int own = std::min(cluster.end * kWidth, tets) - cluster.first * kWidth;
    fill_words(own, cluster.rank, rows, word, words_.data() + cluster.words);
    rows += static_cast<std::size_t>(own) * 9 * cluster.rank;
  }
  for (Half& half : halves_) allocate(half);
}

void TetRows::allocate(Half& half) const {
  std::size_t pairs = 0, packs = 0, rank = 0;
  for (const Cluster& cluster : clusters_) {
    pairs = std::max(pairs, pairs_of(cluster.rank));
    if (!cluster.is_local()) continue;
    packs = std::max(packs, 2 * static_cast<std::size_t>(cluster.modes.twins()));
    rank = std::max(rank, static_cast<std::size_t>(cluster.rank));
  }
  half.local.resize(std::max(2 * pairs, packs * kWidth));
  half.local_sums.resize(2 * pairs);
  half.sums.resize(2 * static_cast<std::size_t>(pairs_));
  half.packs.resize(packs);
  half.hessian.resize(rank * rank);
  half.modes.resize(rank * capacity_);
  half.product.resize(rank * capacity_);
}

std::size_t TetRows::size() const {
  std::size_t words = 0;
  auto block = active_.begin();
  for (const Cluster& cluster : clusters_) {
    const auto begin = block;
    while (block != active_.end() && *block < cluster.end) ++block;
    if (block == begin) continue;
    words += static_cast<std::size_t>(block - begin) * kWidth * 9 * cluster.pairs;
    words += cluster.modes.size();
  }
  return words;
}

void TetRows::set_dimension(int dimension) {
  dimension_ = dimension;
  pairs_ = (dimension + 1) / 2;
  if (!clusters_[0].is_local()) clusters_[0].rank = dimension, clusters_[0].pairs = pairs_;
}

void TetRows::begin(const double* q) {
  std::copy_n(q, dimension_, coordinates_.data());
  if (dimension_ % 2 == 1) coordinates_[dimension_] = 0.0;
  for (Half& half : halves_) std::fill(half.sums.begin(), half.sums.end(), Tets(0.0));
}

void TetRows::enter(const Cluster& cluster, Half& work) const {
  std::fill_n(work.local_sums.begin(), 2 * cluster.pairs, Tets(0.0));
  if (!cluster.is_local()) {
    std::copy_n(coordinates_.begin(), 2 * cluster.pairs, work.local.begin());
    return;
  }
  const LocalModes& modes = cluster.modes;
  modes.multiply(pairs_, coordinates_.data(), work.packs.data());
  for (int pack = 0; pack < 2 * modes.twins(); ++pack)
    for (int lane = 0; lane < kWidth; ++lane)
      work.local[static_cast<std::size_t>(pack) * kWidth + lane] = work.packs[pack][lane];
}

void TetRows::gradients(const Cluster& cluster, const Half& work, int block, Tets G[3][3]) const {
  // Nine named sums stay in registers; an array might not.
  Tets g0(0.0), g1(0.0), g2(0.0), g3(0.0), g4(0.0), g5(0.0), g6(0.0), g7(0.0), g8(0.0);
  const Tets* row = words(cluster, block);
  const double* local = work.local.data();
  for (int pair = 0; pair < cluster.pairs; ++pair, row += 9) {
    const Tets a(local[2 * pair]), b(local[2 * pair + 1]);
    const auto term = [&](int e) { return row[e] * a + second_numbers(row[e]) * b; };
    g0 += term(0), g1 += term(1), g2 += term(2);
    g3 += term(3), g4 += term(4), g5 += term(5);
    g6 += term(6), g7 += term(7), g8 += term(8);
  }
  G[0][0] = g0, G[0][1] = g1, G[0][2] = g2;
  G[1][0] = g3, G[1][1] = g4, G[1][2] = g5;
  G[2][0] = g6, G[2][1] = g7, G[2][2] = g8;
}

void TetRows::add_stresses(const Cluster& cluster, Half& work, int block,
                           const Tets P[3][3]) const {
  // Copies stay in registers, because writes to the sums cannot change them.
  const Tets p0 = P[0][0], p1 = P[0][1], p2 = P[0][2], p3 = P[1][0], p4 = P[1][1], p5 = P[1][2],
             p6 = P[2][0], p7 = P[2][1], p8 = P[2][2];
  // Three sums of three terms: one sum of nine would wait for each addition.
  const auto force = [&](const auto& entry) {
    Tets x = entry(0) * p0, y = entry(1) * p1, z = entry(2) * p2;
    x += entry(3) * p3, y += entry(4) * p4, z += entry(5) * p5;
    x += entry(6) * p6, y += entry(7) * p7, z += entry(8) * p8;
    return x + (y + z);
  };
  const Tets* row = words(cluster, block);
  Tets* sum = work.local_sums.data();
  for (int pair = 0; pair < cluster.pairs; ++pair, row += 9, sum += 2) {
    sum[0] += force([row](int e) { return row[e]; });
    sum[1] += force([row](int e) { return second_numbers(row[e]); });
  }
}

void TetRows::add_forces(const Cluster& cluster, Half& work) const {
  if (!cluster.is_local()) {
    for (int i = 0; i < 2 * cluster.pairs; ++i) work.sums[i] += work.local_sums[i];
    return;
  }
  const LocalModes& modes = cluster.modes;
  for (int pack = 0; pack < 2 * modes.twins(); ++pack)
    for (int lane = 0; lane < kWidth; ++lane) {
      const int i = pack * kWidth + lane;
      work.packs[pack].set(lane, i < cluster.rank ? lane_sum(work.local_sums[i]) : 0.0);
    }
  modes.add_transposed(pairs_, work.packs.data(), work.sums.data());
}

double TetRows::sum(int half, const TetEnergies& energies) {
  double value = 0.0;
  Half& work = halves_[half];
  visit(
      work, blocks_of(half),
      [&](const Cluster& cluster, int block, const Tets G[3][3]) {
        Tets P[3][3];
        value += lane_sum(energies.block_energy(block, G, P));
        add_stresses(cluster, work, block, P);
      },
      [&](const Cluster& cluster) { add_forces(cluster, work); });
  return value;
}

void TetRows::end(double* gradient) const {
  for (int mode = 0; mode < dimension_; ++mode)
    gradient[mode] = lane_sum(halves_[0].sums[mode] + halves_[1].sums[mode]);
}

void TetRows::add_hessian(int half, const TetEnergies& energies, double* hessian) {
  Half& work = halves_[half];
  visit(
      work, blocks_of(half),
      [&](const Cluster& cluster, int block, const Tets G[3][3]) {
        Tets C[9][9];
        energies.block_curvatures(block, G, C);
        add_curvatures(cluster, block, C, cluster.is_local() ? work.hessian.data() : hessian);
      },
      [&](const Cluster& cluster) { add_local_hessian(cluster, work, hessian); });
}

void TetRows::store_curvatures(const TetEnergies& energies, float* to) {
  visit(
      halves_[0], all_,
      [&](const Cluster&, int block, const Tets G[3][3]) {
        Tets C[9][9];
        energies.block_curvatures(block, G, C);
        to = store_lanes<81>(lanes(block), &C[0][0], to);
      },
      [](const Cluster&) {});
}

void TetRows::store_stresses(const TetEnergies& energies, float* to) {
  visit(
      halves_[0], all_,
      [&](const Cluster&, int block, const Tets G[3][3]) {
        Tets P[3][3];
        (void)energies.block_energy(block, G, P);
        to = store_lanes<9>(lanes(block), &P[0][0], to);
      },
      [](const Cluster&) {});
}

void TetRows::add_curvatures(const Cluster& cluster, int block, const Tets curvature[9][9],
                             double* hessian) const {
  // Modes lie in pairs: a word that is read serves four sums.
  const Tets* const own = words(cluster, block);
  const int rank = cluster.rank;
  for (int pair = 0; pair < cluster.pairs; ++pair) {
    Tets change[2][9];
    for (int f = 0; f < 9; ++f) {
      change[0][f] = change[1][f] = Tets(0.0);
      for (int e = 0; e < 9; ++e) {
        change[0][f] += curvature[f][e] * own[9 * pair + e];
        change[1][f] += curvature[f][e] * second_numbers(own[9 * pair + e]);
      }
    }
    for (int other = 0; other <= pair; ++other) {
      Tets sums[2][2] = {{Tets(0.0), Tets(0.0)}, {Tets(0.0), Tets(0.0)}};
      for (int e = 0; e < 9; ++e) {
        const Tets first = own[9 * other + e], second = second_numbers(first);
        for (int i = 0; i < 2; ++i) {
          sums[i][0] += change[i][e] * first;
          sums[i][1] += change[i][e] * second;
        }
      }
      for (int i = 0; i < 2 && 2 * pair + i < rank; ++i) {
        double* const row = hessian + static_cast<std::size_t>(2 * pair + i) * rank;
        for (int j = 0; j < 2 && 2 * other + j <= 2 * pair + i; ++j)
          row[2 * other + j] += lane_sum(sums[i][j]);
      }
    }
  }
}

void TetRows::add_local_hessian(const Cluster& cluster, Half& work, double* hessian) const {
  if (!cluster.is_local()) return;
  const int rank = cluster.rank, d = dimension_;
  const auto row_of = [d](std::vector<double>& matrix, int i) {
    return matrix.data() + static_cast<std::size_t>(i) * d;
  };
  cluster.modes.unpack(rank, d, work.modes.data());
  std::fill_n(work.product.begin(), static_cast<std::size_t>(rank) * d, 0.0);
  for (int i = 0; i < rank; ++i)
    for (int k = 0; k < rank; ++k) {
      const std::size_t entry = static_cast<std::size_t>(std::max(i, k)) * rank + std::min(i, k);
      add_scaled(work.hessian[entry], row_of(work.modes, k), row_of(work.product, i), d);
    }
  for (int i = 0; i < rank; ++i)
    for (int row = 0; row < d; ++row)
      add_scaled(row_of(work.modes, i)[row], row_of(work.product, i),
                 hessian + static_cast<std::size_t>(row) * d, row + 1);
  std::fill_n(work.hessian.begin(), static_cast<std::size_t>(rank) * rank, 0.0);
}

}  // namespace snapspace::online
