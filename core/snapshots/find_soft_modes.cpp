#include "snapshots/find_soft_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "threads/flush_denormals.h"
#include "threads/parallel.h"

namespace snapspace {

namespace {

/// Columns of a block, one per lane: more than are wanted, which lets those converge soon.
constexpr int kBlock = 2 * SoftModes::kCount;
constexpr int kMostSteps = 40;
/// Change of the sum of the wanted eigenvalues in a step that ends the search, as a share.
constexpr double kEnough = 0.03;
/// Solutions are bent and stretched, and stiffer along the modes than the rest shape: by 8 to 60 in
/// the mean on the Dragon. With too small a factor directions overshoot; beyond 40 little changes.
constexpr double kStiffening = 40.0;

using Block = SingleLanes<kBlock>;
using Small = Eigen::MatrixXd;
using Rows = StreamedVector<Block>;

/// Shapes with what A and H make of them, 3n blocks each.
struct Columns {
  Rows shapes, scalar, forces;
  explicit Columns(std::size_t size) : shapes(size, Block(0)), scalar(shapes), forces(shapes) {}
};

/// Columns beside each other.
using Span = std::vector<const Columns*>;

/// Their Gram matrices with A and H.
struct Gram {
  Small scalar, hessian;
};

/// sums += a^T b of the entries from begin to before end, in single precision; kBlock x kBlock.
void add_products(const Rows& a, const Rows& b, std::size_t begin, std::size_t end,
                  Eigen::Ref<Small> all) {
  Block sums[kBlock];
  for (Block& sum : sums) sum = Block(0);
  for (std::size_t i = begin; i < end; ++i) {
    const Block right = b[i];
    for (int k = 0; k < kBlock; ++k) sums[k] += Block(a[i][k]) * right;
  }
  for (int k = 0; k < kBlock; ++k)
    for (int j = 0; j < kBlock; ++j) all(k, j) += sums[k][j];
}

/// The part of some entries, its lower blocks only. All products of a chunk of entries find them in
/// a cache.
Gram partial_gram(const Span& span, std::size_t begin, std::size_t end) {
  constexpr std::size_t kChunk = 128;
  const auto size = static_cast<Eigen::Index>(span.size()) * kBlock;
  Gram gram{Small::Zero(size, size), Small::Zero(size, size)};
  for (; begin < end; begin += kChunk) {
    const std::size_t stop = std::min(end, begin + kChunk);
    for (std::size_t a = 0; a < span.size(); ++a)
      for (std::size_t b = 0; b <= a; ++b) {
        const auto row = static_cast<Eigen::Index>(a) * kBlock;
        const auto column = static_cast<Eigen::Index>(b) * kBlock;
        add_products(span[a]->shapes, span[b]->scalar, begin, stop,
                     gram.scalar.block(row, column, kBlock, kBlock));
        add_products(span[a]->shapes, span[b]->forces, begin, stop,
                     gram.hessian.block(row, column, kBlock, kBlock));
      }
  }
  return gram;
}

/// Parts of all entries, for threads: what they compute is added in this order.
constexpr std::size_t kParts = 16;

template <class Work>
void for_parts(std::size_t size, Work&& work) {
  parallel_for(kParts, 0,
               [&](int part) { work(part, size * part / kParts, size * (part + 1) / kParts); });
}

Gram gram_of(const Span& span) {
  std::vector<Gram> parts(kParts);
  for_parts(span[0]->shapes.size(), [&](int part, std::size_t begin, std::size_t end) {
    parts[part] = partial_gram(span, begin, end);
  });
  Gram sum = parts[0];
  for (std::size_t part = 1; part < kParts; ++part) {
    sum.scalar += parts[part].scalar;
    sum.hessian += parts[part].hessian;
  }
  return sum;
}

/// Hessian at rest, with the handles: elastic forces of small displacements.
void rest_forces(const PosingSystem& system, const Rows& shapes, Rows& forces) {
  system.energy.rest_hessian_product(shapes.data(), forces.data());
  for (std::size_t k = 0; k < system.pinned.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = 3 * static_cast<std::size_t>(system.pinned[k]) + c;
      forces[i] += Block(static_cast<float>(2.0 * system.weights[k])) * shapes[i];
    }
}

/// The lowest kBlock pairs of the pencil (H, A) on a span.
struct Ritz {
  Small coefficients;  // (columns of the span) x kBlock, A-orthonormal
  Eigen::VectorXd values;
};

/// Nothing if the span's columns are dependent to the precision of their products.
std::optional<Ritz> rayleigh_ritz(const Gram& gram) {
  const Eigen::VectorXd lengths = gram.scalar.diagonal().cwiseSqrt();
  if (!(lengths.minCoeff() > 0.0)) return std::nullopt;
  const auto inverse = lengths.cwiseInverse().asDiagonal();
  const Small scalar = inverse * gram.scalar * inverse, hessian = inverse * gram.hessian * inverse;
  const Eigen::LLT<Small> factor(scalar);  // of lower triangles, as everything here
  constexpr double kDependent = 1e-2;      // least root of a pivot; products are of 1e-6
  if (factor.info() != Eigen::Success || factor.matrixLLT().diagonal().minCoeff() < kDependent)
    return std::nullopt;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Small> solver(hessian, scalar);
  return Ritz{inverse * solver.eigenvectors().leftCols(kBlock), solver.eigenvalues().head(kBlock)};
}

/// x = the Ritz vectors, and past = their part outside of what x was.
void combine(const Small& coefficients, Rows& x, const Rows& fresh, Rows& past) {
  Block rows[3 * kBlock];
  for (int k = 0; k < 3 * kBlock; ++k)
    for (int j = 0; j < kBlock; ++j)
      set_lane(rows[k], j, k < coefficients.rows() ? coefficients(k, j) : 0.0);
  for_parts(x.size(), [&](int, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Block outside(0), inside(0);
      for (int k = 0; k < kBlock; ++k) {
        inside += Block(x[i][k]) * rows[k];
        outside += Block(fresh[i][k]) * rows[kBlock + k];
        outside += Block(past[i][k]) * rows[2 * kBlock + k];
      }
      x[i] = inside + outside;
      past[i] = outside;
    }
  });
}

/// Lanes over the square roots of `squares`.
void normalize(const Lanes<kBlock>& squares, Rows& a, Rows& b) {
  Block factor;
  for (int k = 0; k < kBlock; ++k)
    set_lane(factor, k, squares[k] > 0.0 ? 1.0 / std::sqrt(squares[k]) : 0.0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] *= factor;
    b[i] *= factor;
  }
}

/// Numbers in [-1, 1), the same everywhere.
void fill_at_random(Rows& rows) {
  std::uint32_t state = 1;
  for (Block& row : rows)
    for (int k = 0; k < kBlock; ++k) {
      state = state * 1664525u + 1013904223u;
      set_lane(row, k, static_cast<double>(state >> 8) / (1 << 23) - 1.0);
    }
}

/// Columns that the factor makes of `scalar`, normalized.
void precondition(const PosingSystem& system, Columns& columns) {
  const Lanes<kBlock> squares = system.factor.solve(columns.scalar.data(), columns.shapes.data());
  normalize(squares, columns.shapes, columns.scalar);
  rest_forces(system, columns.shapes, columns.forces);
}

SoftModes soft_modes(const Columns& columns, const Eigen::VectorXd& values) {
  StreamedVector<float> modes(columns.shapes.size() * SoftModes::kCount);
  for (std::size_t i = 0; i < columns.shapes.size(); ++i)
    for (int k = 0; k < SoftModes::kCount; ++k)
      modes[i * SoftModes::kCount + k] = columns.shapes[i][k];
  double weights[SoftModes::kCount];
  for (int k = 0; k < SoftModes::kCount; ++k)
    weights[k] = values[k] > 0.0 ? 1.0 / (kStiffening * values[k]) : 0.0;
  return {std::move(modes), weights};
}

}  // namespace

SoftModes find_soft_modes(const PosingSystem& system) {
  const FlushDenormals flush;
  const auto size = static_cast<std::size_t>(system.size());
  Columns x(size), fresh(size), past(size);
  fill_at_random(x.scalar);
  precondition(system, x);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(kBlock);
  const auto improve = [&](const Span& span) {
    const std::optional<Ritz> ritz = rayleigh_ritz(gram_of(span));
    if (!ritz) return false;
    combine(ritz->coefficients, x.shapes, fresh.shapes, past.shapes);
    combine(ritz->coefficients, x.scalar, fresh.scalar, past.scalar);
    combine(ritz->coefficients, x.forces, fresh.forces, past.forces);
    values = ritz->values;
    return true;
  };
  improve({&x});
  double before = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    Block shifts;
    for (int k = 0; k < kBlock; ++k) set_lane(shifts, k, values[k]);
    for (std::size_t i = 0; i < size; ++i) fresh.scalar[i] = x.forces[i] - shifts * x.scalar[i];
    precondition(system, fresh);
    if (!(step > 0 && improve({&x, &fresh, &past})) && !improve({&x, &fresh})) break;
    const double sum = values.head(SoftModes::kCount).sum();
    if (step > 0 && before - sum <= kEnough * sum) break;
    before = sum;
  }
  return soft_modes(x, values);
}

}  // namespace snapspace
