#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "material/tet_material.h"
#include "online/blended_cubature.h"
#include "online/blended_quartic.h"
#include "online/blended_stars.h"
#include "online/blending_solver.h"
#include "online/cubature.h"
#include "online/inertial_minimizer.h"
#include "online/posing_solver.h"
#include "online/quartic.h"
#include "online/residual_probe.h"
#include "online/snapspace_online.h"

/// One of the five solvers, with its coordinates and inputs.
struct snapspace_session {
  using Posing = snapspace::online::PosingSolver<snapspace::online::Quartic>;
  using PosingCubature = snapspace::online::PosingSolver<snapspace::online::Cubature>;
  using Blending = snapspace::online::BlendingSolver<snapspace::online::BlendedQuartic>;
  using BlendingCubature = snapspace::online::BlendingSolver<snapspace::online::BlendedCubature>;
  using BlendingStars = snapspace::online::BlendingSolver<snapspace::online::BlendedStars>;

  std::unique_ptr<Posing> posing;
  std::unique_ptr<PosingCubature> cubature;
  std::unique_ptr<Blending> blending;
  std::unique_ptr<BlendingCubature> blending_cubature;
  std::unique_ptr<BlendingStars> blending_stars;
  std::unique_ptr<snapspace::online::ResidualProbe> probe;
  std::unique_ptr<snapspace::online::InertialMinimizer> inertia;
  snapspace_basis basis;
  std::vector<double> q;         // all coordinates of the model
  std::vector<double> gradient;  // work array of snapspace_value, as long as q
  std::vector<double> state;     // offsets of the handles, or weights of the poses

  void take(std::unique_ptr<Posing> solver) {
    state.assign(12 * static_cast<std::size_t>(solver->handles()), 0.0);
    posing = std::move(solver);
  }
  void take(std::unique_ptr<PosingCubature> solver) {
    state.assign(12 * static_cast<std::size_t>(solver->handles()), 0.0);
    cubature = std::move(solver);
  }
  void take(std::unique_ptr<Blending> solver) {
    state.assign(solver->poses(), 1.0 / solver->poses());
    blending = std::move(solver);
  }
  void take(std::unique_ptr<BlendingCubature> solver) {
    state.assign(solver->poses(), 1.0 / solver->poses());
    blending_cubature = std::move(solver);
  }
  void take(std::unique_ptr<BlendingStars> solver) {
    state.assign(solver->poses(), 1.0 / solver->poses());
    blending_stars = std::move(solver);
  }

  /// Returns act(solver) for the solver of this session.
  template <class Act>
  auto with_solver(Act act) const {
    if (posing) return act(*posing);
    if (cubature) return act(*cubature);
    if (blending) return act(*blending);
    if (blending_cubature) return act(*blending_cubature);
    return act(*blending_stars);
  }
  /// Whether the session blends poses; otherwise it poses handles.
  [[nodiscard]] bool blends() const { return blending || blending_cubature || blending_stars; }
  [[nodiscard]] int dimension() const {
    return with_solver([](const auto& solver) { return solver.dimension(); });
  }
};

namespace snapspace::online {

inline bool all_finite(const double* numbers, std::size_t count) {
  return std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); });
}

/// Reads a material for this many tets.
/// @returns SNAPSPACE_OK, or an error; `result` is then unchanged
inline int read_material(const snapspace_material& given, int tets, TetMaterial& result) {
  if (!given.kind) return SNAPSPACE_BAD_ARGUMENT;
  const int kind = material_index(given.kind);
  if (kind < 0) return SNAPSPACE_UNKNOWN_MATERIAL;
  const bool shared = given.count == 1 && !is_of_shells(kind);
  if (!given.moduli || (!shared && given.count != tets)) return SNAPSPACE_BAD_ARGUMENT;
  const int columns = material_moduli(kind), energies = scaled_moduli(kind);
  const std::size_t size = static_cast<std::size_t>(given.count) * columns;
  if (!all_finite(given.moduli, size)) return SNAPSPACE_NOT_FINITE;
  for (std::size_t i = 0; i < size; ++i)
    if (i % columns < static_cast<std::size_t>(energies) && given.moduli[i] < 0.0)
      return SNAPSPACE_BAD_ARGUMENT;
  result = {kind, given.count, given.moduli};
  return SNAPSPACE_OK;
}

}  // namespace snapspace::online
