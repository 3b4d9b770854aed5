#include "snapshots/find_soft_modes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "dense/symmetric_pencil.h"
#include "multigrid/pseudo_random.h"
#include "snapshots/mode_block.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Columns of a block: more than are wanted, so that the wanted ones converge soon.
constexpr int kBlock = ModeBlock::kColumns;
static_assert(kBlock == 2 * SoftModes::kCount);
constexpr int kMaxSteps = 40;
/// The search ends when a step changes the sum of the wanted eigenvalues by less than this share.
constexpr double kConverged = 0.06;
/// Solutions are bent and stretched, and so stiffer along the modes than the rest shape: by a
/// factor of 8 to 60 on average on the Dragon. With too small a factor directions overshoot; beyond
/// 40 little changes.
constexpr double kStiffening = 40.0;
/// Columns count as dependent if the root of a pivot is below this; products are accurate to 1e-6.
constexpr double kDependent = 1e-2;

using ModePack = ModeBlock::Pack;

/// Shapes, and their products with A and H; each is a block of 3n rows.
struct Columns {
  ModeBlock shapes, scalar, forces;
  explicit Columns(std::size_t size) : shapes(size), scalar(size), forces(size) {}
};

/// The blocks that a step combines: the pairs so far, their preconditioned residuals, and the last
/// change.
struct Span {
  Columns x, fresh, past;
  explicit Span(std::size_t size) : x(size), fresh(size), past(size) {}
  [[nodiscard]] const Columns& operator[](int block) const {
    return block == 0 ? x : block == 1 ? fresh : past;
  }
};

constexpr int kSpan = 3 * kBlock;

/// Gram matrices of a span with A and H, lower triangles only.
struct Gram {
  SquareMatrix scalar{kSpan}, hessian{kSpan};
};

/// Two blocks of a span, the later one first.
using BlockPair = std::array<int, 2>;
using BlockPairs = std::vector<BlockPair>;

/// The products of these pairs, over some entries. A chunk of entries stays in a cache for all of
/// its products.
Gram partial_gram(const Span& span, const BlockPairs& pairs, std::size_t begin, std::size_t end) {
  constexpr std::size_t kChunk = 128;
  Gram gram;
  for (; begin < end; begin += kChunk) {
    const std::size_t stop = std::min(end, begin + kChunk);
    for (const auto& [i, j] : pairs) {
      const Columns &a = span[i], &b = span[j];
      a.shapes.add_products(b.scalar, begin, stop, gram.scalar, i * kBlock, j * kBlock);
      a.shapes.add_products(b.forces, begin, stop, gram.hessian, i * kBlock, j * kBlock);
    }
  }
  return gram;
}

/// Sets the pair's block of `to` to that of `from`, or adds it.
void take_block(const BlockPair& pair, const SquareMatrix& from, bool add, SquareMatrix& to) {
  for (int c = pair[1] * kBlock; c < (pair[1] + 1) * kBlock; ++c)
    for (int r = pair[0] * kBlock; r < (pair[0] + 1) * kBlock; ++r)
      to(r, c) = add ? to(r, c) + from(r, c) : from(r, c);
}

/// Computes the products of these pairs of blocks; the others are left unchanged.
void measure(const Span& span, const BlockPairs& pairs, Gram& gram) {
  std::vector<Gram> parts(kModeParts);
  for_parts(span.x.shapes.size(), [&](int part, std::size_t begin, std::size_t end) {
    parts[part] = partial_gram(span, pairs, begin, end);
  });
  for (const BlockPair& pair : pairs)
    for (int part = 0; part < kModeParts; ++part) {
      take_block(pair, parts[part].scalar, part > 0, gram.scalar);
      take_block(pair, parts[part].hessian, part > 0, gram.hessian);
    }
}

/// The Gram matrices after x and past have been replaced by combinations of the span. This saves
/// computing half of the products again.
Gram combined(const Gram& gram, const std::vector<double>& coefficients) {
  // x has the coefficients, the next block zeros, and past the coefficients without the first block
  std::vector<double> both(std::size_t(kSpan) * kSpan, 0.0);
  std::copy(coefficients.begin(), coefficients.end(), both.begin());
  for (int c = 0; c < kBlock; ++c)
    for (int r = kBlock; r < kSpan; ++r)
      both[(2 * kBlock + c) * kSpan + r] = coefficients[c * kSpan + r];
  return {congruent(gram.scalar, both), congruent(gram.hessian, both)};
}

void fill_randomly(ModeBlock& block) {
  PseudoRandom next;
  for (std::size_t i = 0; i < block.size(); ++i)
    for (int k = 0; k < kBlock; ++k) block.set(i, k, next());
}

/// Divides the lanes of both arrays by the square roots of `squares`.
void normalize(const Sum<ModePack>& squares, std::size_t size, ModePack* a, ModePack* b) {
  ModePack factor;
  for (int k = 0; k < ModeBlock::kLanes; ++k)
    set_lane(factor, k, squares[k] > 0.0 ? 1.0 / std::sqrt(squares[k]) : 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    a[i] *= factor;
    b[i] *= factor;
  }
}

/// Sets the shapes to the inverse times `scalar`, normalized, and the forces to match.
void precondition(const PosingSystem& system, Columns& columns, std::vector<Scratch>& scratch) {
  parallel_for(ModeBlock::kPacks, 0, [&](int p) {
    const FlushDenormals flush;
    ModePack *shapes = columns.shapes.pack(p), *scalar = columns.scalar.pack(p);
    normalize(system.inverse.apply(scalar, shapes, scratch[p]), columns.shapes.size(), shapes,
              scalar);
    system.rest_hessian_product(shapes, columns.forces.pack(p));
  });
}

/// fresh.scalar = the residual of the pairs in x
void set_residuals(const Columns& x, const std::vector<double>& values, Columns& fresh) {
  for (int p = 0; p < ModeBlock::kPacks; ++p) {
    ModePack shifts;
    for (int k = 0; k < ModeBlock::kLanes; ++k)
      set_lane(shifts, k, values[p * ModeBlock::kLanes + k]);
    const ModePack *forces = x.forces.pack(p), *scalar = x.scalar.pack(p);
    ModePack* residual = fresh.scalar.pack(p);
    for (std::size_t i = 0; i < x.scalar.size(); ++i) residual[i] = forces[i] - shifts * scalar[i];
  }
}

SoftModes soft_modes(const Columns& columns, const std::vector<double>& values) {
  StreamedVector<float> modes(columns.shapes.size() * SoftModes::kCount);
  for (std::size_t i = 0; i < columns.shapes.size(); ++i)
    for (int k = 0; k < SoftModes::kCount; ++k)
      modes[i * SoftModes::kCount + k] = columns.shapes.at(i, k);
  double weights[SoftModes::kCount];
  for (int k = 0; k < SoftModes::kCount; ++k)
    weights[k] = values[k] > 0.0 ? 1.0 / (kStiffening * values[k]) : 0.0;
  return {EightModes(std::move(modes)), weights};
}

}  // namespace

SoftModes find_soft_modes(const PosingSystem& system) {
  const FlushDenormals flush;
  Span span(static_cast<std::size_t>(system.size()));
  auto& [x, fresh, past] = span;
  std::vector<Scratch> scratch(ModeBlock::kPacks);
  fill_randomly(x.scalar);
  precondition(system, x, scratch);
  std::vector<double> values(kBlock, 0.0);
  Gram gram;
  const auto improve = [&](int columns) {
    const PencilPairs lowest = lowest_pairs(gram.hessian, gram.scalar, columns, kBlock, kDependent);
    if (lowest.values.empty()) return false;
    std::vector<double> coefficients(std::size_t(kSpan) * kBlock, 0.0);
    for (int c = 0; c < kBlock; ++c)
      std::copy_n(&lowest.coefficients[c * columns], columns, &coefficients[c * kSpan]);
    x.shapes.combine(coefficients, fresh.shapes, past.shapes);
    x.scalar.combine(coefficients, fresh.scalar, past.scalar);
    x.forces.combine(coefficients, fresh.forces, past.forces);
    values = lowest.values;
    gram = combined(gram, coefficients);
    return true;
  };
  measure(span, {{0, 0}}, gram);
  improve(kBlock);
  double before = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    set_residuals(x, values, fresh);
    precondition(system, fresh, scratch);
    measure(span, {{1, 0}, {1, 1}, {2, 1}}, gram);
    if (!(step > 0 && improve(kSpan)) && !improve(2 * kBlock)) break;
    const double sum = std::accumulate(values.begin(), values.begin() + SoftModes::kCount, 0.0);
    if (step > 0 && before - sum <= kConverged * sum) break;
    before = sum;
  }
  return soft_modes(x, values);
}

}  // namespace snapspace
