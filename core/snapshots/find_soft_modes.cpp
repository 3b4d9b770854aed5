#include "snapshots/find_soft_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "multigrid/pseudo_random.h"
#include "snapshots/mode_block.h"
#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Columns of a block: more than are wanted, which lets those converge soon.
constexpr int kBlock = ModeBlock::kColumns;
static_assert(kBlock == 2 * SoftModes::kCount);
constexpr int kMostSteps = 40;
/// Change of the sum of the wanted eigenvalues in a step that ends the search, as a share.
constexpr double kEnough = 0.06;
/// Solutions are bent and stretched, and stiffer along the modes than the rest shape: by 8 to 60 in
/// the mean on the Dragon. With too small a factor directions overshoot; beyond 40 little changes.
constexpr double kStiffening = 40.0;

using Small = ModeBlock::Small;
using Pack = ModeBlock::Pack;

/// Shapes with what A and H make of them, 3n blocks each.
struct Columns {
  ModeBlock shapes, scalar, forces;
  explicit Columns(std::size_t size) : shapes(size), scalar(size), forces(size) {}
};

/// What a step combines: the pairs so far, their preconditioned residuals, and the last change.
struct Span {
  Columns x, fresh, past;
  explicit Span(std::size_t size) : x(size), fresh(size), past(size) {}
  [[nodiscard]] const Columns& operator[](int block) const {
    return block == 0 ? x : block == 1 ? fresh : past;
  }
};

constexpr int kSpan = 3 * kBlock;

/// Gram matrices of a span with A and H, of which only the lower triangles are used.
struct Gram {
  Small scalar = Small::Zero(kSpan, kSpan), hessian = Small::Zero(kSpan, kSpan);
};

/// Two blocks of a span, the later one first.
using BlockPair = std::array<int, 2>;
using BlockPairs = std::vector<BlockPair>;

/// Their products in one of the Gram matrices.
auto products_of(const BlockPair& pair, Small& all) {
  return all.block(pair[0] * kBlock, pair[1] * kBlock, kBlock, kBlock);
}

/// The part of some entries. All products of a chunk of entries find them in a cache.
Gram partial_gram(const Span& span, const BlockPairs& pairs, std::size_t begin, std::size_t end) {
  constexpr std::size_t kChunk = 128;
  Gram gram;
  for (; begin < end; begin += kChunk) {
    const std::size_t stop = std::min(end, begin + kChunk);
    for (const BlockPair& pair : pairs) {
      const Columns &a = span[pair[0]], &b = span[pair[1]];
      a.shapes.add_products(b.scalar, begin, stop, products_of(pair, gram.scalar));
      a.shapes.add_products(b.forces, begin, stop, products_of(pair, gram.hessian));
    }
  }
  return gram;
}

/// Measures the products of these pairs of blocks; the others stay.
void measure(const Span& span, const BlockPairs& pairs, Gram& gram) {
  std::vector<Gram> parts(kModeParts);
  for_parts(span.x.shapes.size(), [&](int part, std::size_t begin, std::size_t end) {
    parts[part] = partial_gram(span, pairs, begin, end);
  });
  for (const BlockPair& pair : pairs) {
    auto scalar = products_of(pair, gram.scalar), hessian = products_of(pair, gram.hessian);
    scalar.setZero();
    hessian.setZero();
    for (Gram& part : parts) {
      scalar += products_of(pair, part.scalar);
      hessian += products_of(pair, part.hessian);
    }
  }
}

/// Of x and past, when they have become combinations of the span: products need not be measured
/// again, which is half of them.
Gram combined(const Gram& gram, const Small& coefficients) {
  Small both = Small::Zero(kSpan, kSpan);
  both.leftCols(kBlock) = coefficients;
  both.bottomRightCorner(2 * kBlock, kBlock) = coefficients.bottomRows(2 * kBlock);
  const auto of = [&](const Small& all) -> Small {
    return both.transpose() * (all.selfadjointView<Eigen::Lower>() * both);
  };
  return {of(gram.scalar), of(gram.hessian)};
}

/// The lowest kBlock pairs of the pencil (H, A) on a span.
struct Ritz {
  Small coefficients;  // (columns of the span) x kBlock, A-orthonormal
  Eigen::VectorXd values;
};

/// On the first columns of a span. Nothing if these are dependent to the precision of their
/// products.
std::optional<Ritz> rayleigh_ritz(const Gram& gram, int columns) {
  const Eigen::VectorXd lengths = gram.scalar.diagonal().head(columns).cwiseSqrt();
  if (!(lengths.minCoeff() > 0.0)) return std::nullopt;
  const auto inverse = lengths.cwiseInverse().asDiagonal();
  const Small scalar = inverse * gram.scalar.topLeftCorner(columns, columns) * inverse;
  const Small hessian = inverse * gram.hessian.topLeftCorner(columns, columns) * inverse;
  const Eigen::LLT<Small> factor(scalar);  // of lower triangles, as everything here
  constexpr double kDependent = 1e-2;      // least root of a pivot; products are of 1e-6
  if (factor.info() != Eigen::Success || factor.matrixLLT().diagonal().minCoeff() < kDependent)
    return std::nullopt;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Small> solver(hessian, scalar);
  return Ritz{inverse * solver.eigenvectors().leftCols(kBlock), solver.eigenvalues().head(kBlock)};
}

void fill_at_random(ModeBlock& block) {
  PseudoRandom next;
  for (std::size_t i = 0; i < block.size(); ++i)
    for (int k = 0; k < kBlock; ++k) block.set(i, k, next());
}

/// Lanes over the square roots of `squares`.
void normalize(const Sum<Pack>& squares, std::size_t size, Pack* a, Pack* b) {
  Pack factor;
  for (int k = 0; k < ModeBlock::kLanes; ++k)
    set_lane(factor, k, squares[k] > 0.0 ? 1.0 / std::sqrt(squares[k]) : 0.0);
  for (std::size_t i = 0; i < size; ++i) {
    a[i] *= factor;
    b[i] *= factor;
  }
}

/// Columns that the inverse makes of `scalar`, normalized.
void precondition(const PosingSystem& system, Columns& columns, std::vector<Scratch>& scratch) {
  parallel_for(ModeBlock::kPacks, 0, [&](int p) {
    const FlushDenormals flush;
    Pack *shapes = columns.shapes.pack(p), *scalar = columns.scalar.pack(p);
    normalize(system.inverse.apply(scalar, shapes, scratch[p]), columns.shapes.size(), shapes,
              scalar);
    system.rest_hessian_product(shapes, columns.forces.pack(p));
  });
}

/// fresh.scalar = the residual of the pairs in x
void set_residuals(const Columns& x, const Eigen::VectorXd& values, Columns& fresh) {
  for (int p = 0; p < ModeBlock::kPacks; ++p) {
    Pack shifts;
    for (int k = 0; k < ModeBlock::kLanes; ++k)
      set_lane(shifts, k, values[p * ModeBlock::kLanes + k]);
    const Pack *forces = x.forces.pack(p), *scalar = x.scalar.pack(p);
    Pack* residual = fresh.scalar.pack(p);
    for (std::size_t i = 0; i < x.scalar.size(); ++i) residual[i] = forces[i] - shifts * scalar[i];
  }
}

SoftModes soft_modes(const Columns& columns, const Eigen::VectorXd& values) {
  StreamedVector<float> modes(columns.shapes.size() * SoftModes::kCount);
  for (std::size_t i = 0; i < columns.shapes.size(); ++i)
    for (int k = 0; k < SoftModes::kCount; ++k)
      modes[i * SoftModes::kCount + k] = columns.shapes.at(i, k);
  double weights[SoftModes::kCount];
  for (int k = 0; k < SoftModes::kCount; ++k)
    weights[k] = values[k] > 0.0 ? 1.0 / (kStiffening * values[k]) : 0.0;
  return {std::move(modes), weights};
}

}  // namespace

SoftModes find_soft_modes(const PosingSystem& system) {
  const FlushDenormals flush;
  Span span(static_cast<std::size_t>(system.size()));
  auto& [x, fresh, past] = span;
  std::vector<Scratch> scratch(ModeBlock::kPacks);
  fill_at_random(x.scalar);
  precondition(system, x, scratch);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(kBlock);
  Gram gram;
  const auto improve = [&](int columns) {
    const std::optional<Ritz> ritz = rayleigh_ritz(gram, columns);
    if (!ritz) return false;
    Small coefficients = Small::Zero(kSpan, kBlock);
    coefficients.topRows(columns) = ritz->coefficients;
    x.shapes.combine(coefficients, fresh.shapes, past.shapes);
    x.scalar.combine(coefficients, fresh.scalar, past.scalar);
    x.forces.combine(coefficients, fresh.forces, past.forces);
    values = ritz->values;
    gram = combined(gram, coefficients);
    return true;
  };
  measure(span, {{0, 0}}, gram);
  improve(kBlock);
  double before = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    set_residuals(x, values, fresh);
    precondition(system, fresh, scratch);
    measure(span, {{1, 0}, {1, 1}, {2, 1}}, gram);
    if (!(step > 0 && improve(kSpan)) && !improve(2 * kBlock)) break;
    const double sum = values.head(SoftModes::kCount).sum();
    if (step > 0 && before - sum <= kEnough * sum) break;
    before = sum;
  }
  return soft_modes(x, values);
}

}  // namespace snapspace
