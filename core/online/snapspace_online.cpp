#include "online/snapspace_online.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

#include "online/displacement_rows.h"
#include "online/read_cubature.h"
#include "online/reconstruct.h"
#include "online/session.h"

using snapspace::TetMaterial;
using snapspace::online::all_finite;
using snapspace::online::BlendedCubature;
using snapspace::online::BlendedQuartic;
using snapspace::online::BlendedStars;
using snapspace::online::BlendingSolver;
using snapspace::online::clusters_of;
using snapspace::online::Cubature;
using snapspace::online::InertialMinimizer;
using snapspace::online::is_cubature;
using snapspace::online::Method;
using snapspace::online::Quartic;
using snapspace::online::read_material;
using snapspace::online::Report;
using snapspace::online::StepReport;
using snapspace::online::Termination;
using PosingSolver = snapspace::online::PosingSolver<Quartic>;
using CubatureSolver = snapspace::online::PosingSolver<Cubature>;
using BlendingQuarticSolver = BlendingSolver<BlendedQuartic>;
using BlendingCubatureSolver = BlendingSolver<BlendedCubature>;
using BlendingStarsSolver = BlendingSolver<BlendedStars>;

namespace {

bool is_basis(const snapspace_basis* basis) {
  return basis && basis->vertices >= 0 && (basis->vertices == 0 || (basis->tau && basis->modes));
}

bool are_stars(const snapspace_stars* stars) {
  return stars && stars->poses >= 1 && stars->stars >= 1 && stars->rows && stars->weights &&
         stars->origins && stars->forms;
}

snapspace_session* fail(int* error, int code) {
  if (error) *error = code;
  return nullptr;
}

/// A session at q = 0; an error if the solver is not valid.
template <class Solver>
snapspace_session* begin(std::unique_ptr<Solver> solver, const snapspace_basis& basis, int* error) {
  if (!solver->valid()) return fail(error, SNAPSPACE_NOT_DEFINITE);
  auto session = std::make_unique<snapspace_session>();
  session->q.assign(solver->dimension(), 0.0);
  session->gradient.assign(solver->dimension(), 0.0);
  session->basis = basis;
  session->take(std::move(solver));
  if (error) *error = SNAPSPACE_OK;
  return session.release();
}

template <class Solver>
int set_offsets(snapspace_session& session, Solver& solver, const double* offsets) {
  const std::size_t size = session.state.size();
  if (!all_finite(offsets, size)) return SNAPSPACE_NOT_FINITE;
  solver.set_offsets(offsets);
  std::copy_n(offsets, size, session.state.data());
  return SNAPSPACE_OK;
}

bool are_options(const snapspace_options* options) {
  return options && options->tolerance > 0.0 && options->value_scale > 0.0 &&
         options->coordinate_scale > 0.0 && options->max_iterations >= 1 &&
         options->max_evaluations >= 1;
}

std::pair<Method, Termination> read_options(const snapspace_options& options) {
  return {options.method == SNAPSPACE_BFGS ? Method::bfgs : Method::newton,
          {options.tolerance, options.value_scale, options.coordinate_scale, options.max_iterations,
           options.max_evaluations}};
}

snapspace_report c_report(const Report& report) {
  return {static_cast<snapspace_status>(report.status), report.iterations, report.evaluations,
          report.value, report.gradient_norm};
}

InertialMinimizer& inertia_of(snapspace_session& session) {
  if (!session.inertia)
    session.inertia = std::make_unique<InertialMinimizer>(static_cast<int>(session.q.size()));
  return *session.inertia;
}

}  // namespace

int snapspace_moduli(const char* kind) {
  if (!kind) return SNAPSPACE_BAD_ARGUMENT;
  const int index = snapspace::material_index(kind);
  return index < 0 ? SNAPSPACE_UNKNOWN_MATERIAL : snapspace::material_moduli(index);
}

const char* snapspace_modulus_name(const char* kind, int modulus) {
  if (modulus < 0 || modulus >= snapspace_moduli(kind)) return nullptr;
  return snapspace::modulus_name(snapspace::material_index(kind), modulus);
}

int snapspace_value_scale(const snapspace_material* material, int tets, const double* volumes,
                          double* value_scale) {
  if (!material || tets < 1 || !volumes || !value_scale) return SNAPSPACE_BAD_ARGUMENT;
  TetMaterial of_tets;
  const int code = read_material(*material, tets, of_tets);
  if (code != SNAPSPACE_OK) return code;
  double sum = 0.0;
  for (int t = 0; t < tets; ++t) sum += of_tets.small_strains(t).mu * volumes[t];
  *value_scale = 0.01 * sum;
  return SNAPSPACE_OK;
}

int snapspace_displacement_rows(int tets, int dimension, const double* points, const double* modes,
                                const double* shell_moduli, float* rows) {
  if (tets < 1 || dimension < 1 || !points || !modes || !rows) return SNAPSPACE_BAD_ARGUMENT;
  snapspace::online::displacement_rows(tets, dimension, points, modes, shell_moduli, rows);
  return SNAPSPACE_OK;
}

int snapspace_shell_moduli(const char* kind, int elements, const double* points,
                           const double* shell_moduli, const double* area_products,
                           double* moduli) {
  if (!kind || elements < 1 || !points || !shell_moduli || !moduli) return SNAPSPACE_BAD_ARGUMENT;
  const int index = snapspace::material_index(kind);
  if (index < 0) return SNAPSPACE_UNKNOWN_MATERIAL;
  if (!snapspace::is_of_shells(index)) return SNAPSPACE_BAD_ARGUMENT;
  snapspace::online::shell_moduli(index, elements, points, shell_moduli, area_products, moduli);
  return SNAPSPACE_OK;
}

snapspace_session* snapspace_create_posing(int dimension, int handles, const double* quartic,
                                           const double* K, const double* L, const double* S,
                                           const snapspace_basis* basis, int* error) {
  if (dimension < 1 || handles < 1 || !quartic || !K || !L || !S || !is_basis(basis))
    return fail(error, SNAPSPACE_BAD_ARGUMENT);
  Quartic elastic(dimension, quartic);
  return begin(std::make_unique<PosingSolver>(std::move(elastic), handles, K, L, S), *basis, error);
}

snapspace_session* snapspace_create_posing_cubature(int dimension, int handles,
                                                    const snapspace_cubature* cubature,
                                                    const double* K, const double* L,
                                                    const double* S, const snapspace_basis* basis,
                                                    int* error) {
  if (dimension < 1 || handles < 1 || !is_cubature(cubature) || !K || !L || !S || !is_basis(basis))
    return fail(error, SNAPSPACE_BAD_ARGUMENT);
  TetMaterial material;
  const int code = read_material(cubature->material, cubature->tets, material);
  if (code != SNAPSPACE_OK) return fail(error, code);
  Cubature elastic(dimension, cubature->tets, cubature->rows, cubature->weights, material,
                   clusters_of(*cubature));
  return begin(std::make_unique<CubatureSolver>(std::move(elastic), handles, K, L, S), *basis,
               error);
}

snapspace_session* snapspace_create_blending(int dimension, int poses, const double* quartics,
                                             const snapspace_basis* basis, int* error) {
  if (dimension < 1 || poses < 1 || !quartics || !is_basis(basis))
    return fail(error, SNAPSPACE_BAD_ARGUMENT);
  BlendedQuartic elastic(dimension, poses, quartics);
  return begin(std::make_unique<BlendingQuarticSolver>(std::move(elastic)), *basis, error);
}

snapspace_session* snapspace_create_blending_cubature(int dimension, int poses,
                                                      const snapspace_cubature* cubature,
                                                      const double* corners, const double* tau,
                                                      const snapspace_basis* basis, int* error) {
  if (dimension < 1 || poses < 1 || !is_cubature(cubature) || !corners || !tau || !is_basis(basis))
    return fail(error, SNAPSPACE_BAD_ARGUMENT);
  TetMaterial material;
  const int code = read_material(cubature->material, cubature->tets, material);
  if (code != SNAPSPACE_OK) return fail(error, code);
  if (snapspace::is_of_stars(material.kind)) return fail(error, SNAPSPACE_BAD_ARGUMENT);
  BlendedCubature elastic(dimension, cubature->tets, cubature->rows, cubature->weights, material,
                          {poses, corners, tau}, clusters_of(*cubature));
  return begin(std::make_unique<BlendingCubatureSolver>(std::move(elastic)), *basis, error);
}

snapspace_session* snapspace_create_blending_stars(int dimension, const snapspace_stars* stars,
                                                   const snapspace_basis* basis, int* error) {
  if (dimension < 1 || !are_stars(stars) || !is_basis(basis))
    return fail(error, SNAPSPACE_BAD_ARGUMENT);
  TetMaterial material;
  const int code = read_material(stars->material, stars->poses * stars->stars, material);
  if (code != SNAPSPACE_OK) return fail(error, code);
  if (!snapspace::is_of_stars(material.kind)) return fail(error, SNAPSPACE_BAD_ARGUMENT);
  BlendedStars elastic(dimension, {stars->poses, stars->stars, stars->rows, stars->weights,
                                   material, stars->origins, stars->forms});
  return begin(std::make_unique<BlendingStarsSolver>(std::move(elastic)), *basis, error);
}

void snapspace_destroy(snapspace_session* session) { delete session; }

int snapspace_set_offsets(snapspace_session* session, const double* offsets) {
  if (!session || !offsets) return SNAPSPACE_BAD_ARGUMENT;
  if (session->posing) return set_offsets(*session, *session->posing, offsets);
  if (session->cubature) return set_offsets(*session, *session->cubature, offsets);
  return SNAPSPACE_WRONG_KIND;
}

int snapspace_set_weights(snapspace_session* session, const double* weights) {
  if (!session || !weights) return SNAPSPACE_BAD_ARGUMENT;
  if (!session->blends()) return SNAPSPACE_WRONG_KIND;
  if (!all_finite(weights, session->state.size())) return SNAPSPACE_NOT_FINITE;
  if (session->blending) session->blending->set_weights(weights);
  if (session->blending_cubature) session->blending_cubature->set_weights(weights);
  if (session->blending_stars) session->blending_stars->set_weights(weights);
  std::copy_n(weights, session->state.size(), session->state.data());
  return SNAPSPACE_OK;
}

int snapspace_set_dimension(snapspace_session* session, int dimension) {
  if (!session || dimension < 1 || dimension > static_cast<int>(session->q.size()))
    return SNAPSPACE_BAD_ARGUMENT;
  std::fill(session->q.begin() + std::min(dimension, session->dimension()), session->q.end(), 0.0);
  session->with_solver([&](auto& solver) { solver.set_dimension(dimension); });
  return SNAPSPACE_OK;
}

int snapspace_dimension(const snapspace_session* session) {
  return session ? session->dimension() : SNAPSPACE_BAD_ARGUMENT;
}

int snapspace_solve(snapspace_session* session, const snapspace_options* options,
                    snapspace_report* report) {
  if (!session || !report || !are_options(options)) return SNAPSPACE_BAD_ARGUMENT;
  const auto [method, stop] = read_options(*options);
  double* q = session->q.data();
  const Report result =
      session->with_solver([&](auto& solver) { return solver.solve(q, method, stop); });
  *report = c_report(result);
  return SNAPSPACE_OK;
}

int snapspace_softest(snapspace_session* session, double* curvature) {
  if (!session || !curvature) return SNAPSPACE_BAD_ARGUMENT;
  InertialMinimizer& inertia = inertia_of(*session);
  *curvature = session->with_solver([&](auto& solver) { return solver.softest(inertia); });
  return SNAPSPACE_OK;
}

int snapspace_step(snapspace_session* session, double weight, const double* target,
                   const snapspace_options* options, snapspace_report* report, double* before) {
  if (!session || !target || !report || !before || !are_options(options) || !(weight > 0.0))
    return SNAPSPACE_BAD_ARGUMENT;
  if (!all_finite(target, session->dimension()) || !std::isfinite(weight))
    return SNAPSPACE_NOT_FINITE;
  const auto [method, stop] = read_options(*options);
  InertialMinimizer& inertia = inertia_of(*session);
  double* q = session->q.data();
  const auto step = [&, method = method, stop = stop](auto& solver) {
    return solver.step(inertia, weight, target, method, q, stop);
  };
  const StepReport result = session->with_solver(step);
  *report = c_report(result.report);
  *before = result.before;
  return SNAPSPACE_OK;
}

int snapspace_value(snapspace_session* session, const double* q, double* value) {
  if (!session || !q || !value) return SNAPSPACE_BAD_ARGUMENT;
  if (!all_finite(q, session->dimension())) return SNAPSPACE_NOT_FINITE;
  double* gradient = session->gradient.data();
  *value =
      session->with_solver([&](auto& solver) { return solver.value_and_gradient(q, gradient); });
  return SNAPSPACE_OK;
}

int snapspace_get_q(const snapspace_session* session, double* q) {
  if (!session || !q) return SNAPSPACE_BAD_ARGUMENT;
  std::copy_n(session->q.data(), session->dimension(), q);
  return SNAPSPACE_OK;
}

int snapspace_set_q(snapspace_session* session, const double* q) {
  if (!session || !q) return SNAPSPACE_BAD_ARGUMENT;
  if (!all_finite(q, session->dimension())) return SNAPSPACE_NOT_FINITE;
  std::copy_n(q, session->dimension(), session->q.data());
  return SNAPSPACE_OK;
}

int snapspace_get_vertices(const snapspace_session* session, double* vertices) {
  if (!session || !vertices || session->basis.vertices == 0) return SNAPSPACE_BAD_ARGUMENT;
  const snapspace_basis& basis = session->basis;
  snapspace::online::reconstruct(3 * static_cast<std::size_t>(basis.vertices), session->dimension(),
                                 basis.tau, basis.modes, session->q.data(), vertices);
  return SNAPSPACE_OK;
}
