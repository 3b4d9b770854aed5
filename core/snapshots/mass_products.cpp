#include "snapshots/mass_products.h"

#include <algorithm>

#include "memory/streamed_vector.h"
#include "simd/lanes.h"
#include "simd/memory.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Number of parts of a given size in a range; the last part may be smaller.
int parts(std::size_t range, std::size_t size) {
  return static_cast<int>((range + size - 1) / size);
}

}  // namespace

/// The products and their memory.
class MassProducts::Blocks {
 public:
  explicit Blocks(const ScalarRows& mass) : mass_(mass) {}

  void multiply(Rows rows, const double* offset, Rows others, int threads, double* products);

 private:
  using Wide = Lanes<kWideLanes>;
  static constexpr std::size_t kGroup = 8;
  using GroupPack = Lanes<kGroup>;

  /// Blocks of four rows and of three others take 21 kB, which fit into the first-level cache.
  static constexpr std::size_t kVertices = 128;
  static constexpr std::size_t kPacks = 3 * kVertices / kWideLanes;
  static constexpr std::size_t kHeight = 4, kBreadth = 3;
  /// Vertices of one thread's part of M times the others.
  static constexpr std::size_t kRange = 8 * kVertices;
  /// Rows of one thread's part; the others are read once per part.
  static constexpr std::size_t kPart = 8 * kHeight;

  /// The part of one row for some vertices, with zeros beyond the last vertex.
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
  std::size_t breadth_ = 0;           // number of others, padded with some of any content
  StreamedVector<Block> weighted_;    // M times the others: vertices first, then others
  StreamedVector<GroupPack> points_;  // points of eight of the others
};

MassProducts::MassProducts(const ScalarRows& mass) : blocks_(std::make_unique<Blocks>(mass)) {}
MassProducts::~MassProducts() = default;

void MassProducts::multiply(Rows rows, const double* offset, Rows others, int threads,
                            double* products) {
  blocks_->multiply(rows, offset, others, threads, products);
}

void MassProducts::Blocks::multiply(Rows rows, const double* offset, Rows others, int threads,
                                    double* products) {
  const std::size_t breadth = others.size();
  std::fill_n(products, rows.size() * breadth, 0.0);
  weigh(others, threads);
  parallel_for(parts(rows.size(), kPart), threads, [&](int part) {
    const std::size_t begin = part * kPart, end = std::min(begin + kPart, rows.size());
    StreamedVector<Block> blocks(kHeight, Block{});
    for (std::size_t first = 0; first < mass_.size; first += kVertices) {
      const std::size_t last = std::min(first + kVertices, mass_.size);
      const Block* weighted = weighted_.data() + first / kVertices * breadth_;
      for (std::size_t i = begin; i < end; i += kHeight) {
        const std::size_t height = std::min(kHeight, end - i);
        for (std::size_t k = 0; k < height; ++k) copy(rows[i + k], offset, first, last, blocks[k]);
        for (std::size_t j = 0; j < breadth; j += kBreadth)
          add_tile(blocks.data(), weighted + j, height, std::min(kBreadth, breadth - j),
                   products + i * breadth + j, breadth);
      }
    }
  });
}

/// Sets weighted_ to M times the others.
void MassProducts::Blocks::weigh(Rows others, int threads) {
  const std::size_t breadth = parts(others.size(), kBreadth) * kBreadth;
  if (breadth != breadth_) {  // entries beyond the last vertex stay zero from then on
    breadth_ = breadth;
    weighted_.assign(parts(mass_.size, kVertices) * breadth, Block{});
  }
  points_.resize(3 * mass_.size);
  const auto by_vertices = [&](auto&& work) {
    parallel_for(parts(mass_.size, kRange), threads, [&](int part) {
      const std::size_t begin = part * kRange;
      work(begin, std::min(begin + kRange, mass_.size));
    });
  };
  for (std::size_t first = 0; first < others.size(); first += kGroup) {
    const Rows group = others.subspan(first, std::min(kGroup, others.size() - first));
    by_vertices([&](std::size_t begin, std::size_t end) { interleave(group, begin, end); });
    by_vertices(
        [&](std::size_t begin, std::size_t end) { weigh(first, group.size(), begin, end); });
  }
}

/// Sets points_ at some vertices. Lanes beyond the group repeat its first row, and are not used.
void MassProducts::Blocks::interleave(Rows group, std::size_t begin, std::size_t end) {
  const double* rows[kGroup];
  for (std::size_t j = 0; j < kGroup; ++j) rows[j] = group[j < group.size() ? j : 0];
  for (std::size_t i = 3 * begin; i < 3 * end; ++i) {
    double lanes[kGroup];
    for (std::size_t j = 0; j < kGroup; ++j) lanes[j] = rows[j][i];
    points_[i] = load<kGroup>(lanes);
  }
}

/// Sets weighted_ at some vertices, for `count` others from `first` on.
void MassProducts::Blocks::weigh(std::size_t first, std::size_t count, std::size_t begin,
                                 std::size_t end) {
  for (std::size_t vertex = begin; vertex < end; ++vertex) {
    GroupPack x(0.0), y(0.0), z(0.0);
    for (std::int32_t entry = mass_.starts[vertex]; entry < mass_.starts[vertex + 1]; ++entry) {
      const GroupPack value(mass_.values[entry]);
      const GroupPack* point = &points_[3 * static_cast<std::size_t>(mass_.columns[entry])];
      x += value * point[0];
      y += value * point[1];
      z += value * point[2];
    }
    Block* blocks = &weighted_[vertex / kVertices * breadth_ + first];
    for (std::size_t j = 0; j < count; ++j) {
      double* product = blocks[j].numbers() + 3 * (vertex % kVertices);
      product[0] = x[static_cast<int>(j)];
      product[1] = y[static_cast<int>(j)];
      product[2] = z[static_cast<int>(j)];
    }
  }
}

/// Sets a block to that of a row plus an offset.
void MassProducts::Blocks::copy(const double* row, const double* offset, std::size_t first,
                                std::size_t last, Block& block) {
  double* to = block.numbers();
  std::fill(std::copy(row + 3 * first, row + 3 * last, to), to + 3 * kVertices, 0.0);
  if (!offset) return;
  for (std::size_t i = 3 * first; i < 3 * last; ++i) *to++ += offset[i];
}

/// products += blocks of `kHeight` rows times those of `kBreadth` others. Only the first `height`
/// rows and `breadth` others are added.
void MassProducts::Blocks::add_tile(const Block* rows, const Block* others, std::size_t height,
                                    std::size_t breadth, double* products, std::size_t stride) {
  Wide sums[kHeight * kBreadth];
#pragma GCC unroll 12
  for (Wide& sum : sums) sum = Wide(0.0);
  for (std::size_t k = 0; k < kPacks; ++k) {
    static_assert(kBreadth == 3);  // three variables: an array would be stored in every iteration
    const Wide a = others[0].packs[k], b = others[1].packs[k], c = others[2].packs[k];
#pragma GCC unroll 4
    for (std::size_t i = 0; i < kHeight; ++i) {
      Wide row = rows[i].packs[k];
      keep_in_register(row);
      sums[i * kBreadth] += row * a;
      sums[i * kBreadth + 1] += row * b;
      sums[i * kBreadth + 2] += row * c;
    }
  }
  double totals[kHeight * kBreadth];
  lane_sums<kHeight * kBreadth>(sums, totals);
  for (std::size_t i = 0; i < height; ++i)
    for (std::size_t j = 0; j < breadth; ++j) products[i * stride + j] += totals[i * kBreadth + j];
}

}  // namespace snapspace
