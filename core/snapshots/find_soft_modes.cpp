#include "snapshots/find_soft_modes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
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
constexpr double kEnough = 0.03;
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

/// Columns beside each other.
using Span = std::vector<const Columns*>;

/// Their Gram matrices with A and H.
struct Gram {
  Small scalar, hessian;
};

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
        span[a]->shapes.add_products(span[b]->scalar, begin, stop,
                                     gram.scalar.block(row, column, kBlock, kBlock));
        span[a]->shapes.add_products(span[b]->forces, begin, stop,
                                     gram.hessian.block(row, column, kBlock, kBlock));
      }
  }
  return gram;
}

Gram gram_of(const Span& span) {
  std::vector<Gram> parts(kModeParts);
  for_parts(span[0]->shapes.size(), [&](int part, std::size_t begin, std::size_t end) {
    parts[part] = partial_gram(span, begin, end);
  });
  Gram sum = parts[0];
  for (int part = 1; part < kModeParts; ++part) {
    sum.scalar += parts[part].scalar;
    sum.hessian += parts[part].hessian;
  }
  return sum;
}

/// Hessian at rest, with the handles: elastic forces of small displacements.
void rest_forces(const PosingSystem& system, const Pack* shapes, Pack* forces) {
  system.energy.rest_hessian_product(shapes, forces);
  for (std::size_t k = 0; k < system.pinned.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const std::size_t i = 3 * static_cast<std::size_t>(system.pinned[k]) + c;
      forces[i] += Pack(static_cast<float>(2.0 * system.weights[k])) * shapes[i];
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
    rest_forces(system, shapes, columns.forces.pack(p));
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
  const auto size = static_cast<std::size_t>(system.size());
  Columns x(size), fresh(size), past(size);
  std::vector<Scratch> scratch(ModeBlock::kPacks);
  fill_at_random(x.scalar);
  precondition(system, x, scratch);
  Eigen::VectorXd values = Eigen::VectorXd::Zero(kBlock);
  const auto improve = [&](const Span& span) {
    const std::optional<Ritz> ritz = rayleigh_ritz(gram_of(span));
    if (!ritz) return false;
    Small coefficients = Small::Zero(3 * kBlock, kBlock);
    coefficients.topRows(ritz->coefficients.rows()) = ritz->coefficients;
    x.shapes.combine(coefficients, fresh.shapes, past.shapes);
    x.scalar.combine(coefficients, fresh.scalar, past.scalar);
    x.forces.combine(coefficients, fresh.forces, past.forces);
    values = ritz->values;
    return true;
  };
  improve({&x});
  double before = 0.0;
  for (int step = 0; step < kMostSteps; ++step) {
    set_residuals(x, values, fresh);
    precondition(system, fresh, scratch);
    if (!(step > 0 && improve({&x, &fresh, &past})) && !improve({&x, &fresh})) break;
    const double sum = values.head(SoftModes::kCount).sum();
    if (step > 0 && before - sum <= kEnough * sum) break;
    before = sum;
  }
  return soft_modes(x, values);
}

}  // namespace snapspace
