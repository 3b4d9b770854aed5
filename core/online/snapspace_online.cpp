#include "online/snapspace_online.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

#include "online/blending_solver.h"
#include "online/posing_solver.h"
#include "online/quartic.h"
#include "online/reconstruct.h"

using snapspace::online::BlendingSolver;
using snapspace::online::Method;
using snapspace::online::Quartic;
using snapspace::online::Report;
using PosingSolver = snapspace::online::PosingSolver<Quartic>;

/// One of the two solvers, with its coordinates.
struct snapspace_session {
  std::unique_ptr<PosingSolver> posing;
  std::unique_ptr<BlendingSolver> blending;
  snapspace_basis basis;
  std::vector<double> q;         // as many as the model has
  std::vector<double> gradient;  // as many; of a value that is asked for

  [[nodiscard]] int dimension() const {
    return posing ? posing->dimension() : blending->dimension();
  }
};

namespace {

bool all_finite(const double* numbers, std::size_t count) {
  return std::all_of(numbers, numbers + count, [](double x) { return std::isfinite(x); });
}

bool is_basis(const snapspace_basis* basis) {
  return basis && basis->vertices >= 0 && (basis->vertices == 0 || (basis->tau && basis->modes));
}

snapspace_session* fail(int* error, int code) {
  if (error) *error = code;
  return nullptr;
}

snapspace_session* succeed(int* error, std::unique_ptr<snapspace_session> session) {
  if (error) *error = SNAPSPACE_OK;
  return session.release();
}

}  // namespace

snapspace_session* snapspace_create_posing(int dimension, int handles, const double* quartic,
                                           const double* K, const double* L, const double* S,
                                           const snapspace_basis* basis, int* error) {
  if (dimension < 1 || handles < 1 || !quartic || !K || !L || !S || !is_basis(basis))
    return fail(error, SNAPSPACE_BAD_ARGUMENT);
  auto solver = std::make_unique<PosingSolver>(Quartic(dimension, quartic), handles, K, L, S);
  if (!solver->valid()) return fail(error, SNAPSPACE_NOT_DEFINITE);
  auto session = std::make_unique<snapspace_session>();
  session->posing = std::move(solver);
  session->basis = *basis;
  session->q.assign(dimension, 0.0);
  session->gradient.assign(dimension, 0.0);
  return succeed(error, std::move(session));
}

snapspace_session* snapspace_create_blending(int dimension, int poses, const double* quartics,
                                             const snapspace_basis* basis, int* error) {
  if (dimension < 1 || poses < 1 || !quartics || !is_basis(basis))
    return fail(error, SNAPSPACE_BAD_ARGUMENT);
  auto solver = std::make_unique<BlendingSolver>(dimension, poses, quartics);
  if (!solver->valid()) return fail(error, SNAPSPACE_NOT_DEFINITE);
  auto session = std::make_unique<snapspace_session>();
  session->blending = std::move(solver);
  session->basis = *basis;
  session->q.assign(dimension, 0.0);
  session->gradient.assign(dimension, 0.0);
  return succeed(error, std::move(session));
}

void snapspace_destroy(snapspace_session* session) { delete session; }

int snapspace_set_offsets(snapspace_session* session, const double* offsets) {
  if (!session || !offsets) return SNAPSPACE_BAD_ARGUMENT;
  if (!session->posing) return SNAPSPACE_WRONG_KIND;
  if (!all_finite(offsets, 12 * static_cast<std::size_t>(session->posing->handles())))
    return SNAPSPACE_NOT_FINITE;
  session->posing->set_offsets(offsets);
  return SNAPSPACE_OK;
}

int snapspace_set_weights(snapspace_session* session, const double* weights) {
  if (!session || !weights) return SNAPSPACE_BAD_ARGUMENT;
  if (!session->blending) return SNAPSPACE_WRONG_KIND;
  if (!all_finite(weights, session->blending->poses())) return SNAPSPACE_NOT_FINITE;
  session->blending->set_weights(weights);
  return SNAPSPACE_OK;
}

int snapspace_set_dimension(snapspace_session* session, int dimension) {
  if (!session || dimension < 1 || dimension > static_cast<int>(session->q.size()))
    return SNAPSPACE_BAD_ARGUMENT;
  std::fill(session->q.begin() + std::min(dimension, session->dimension()), session->q.end(), 0.0);
  if (session->posing)
    session->posing->set_dimension(dimension);
  else
    session->blending->set_dimension(dimension);
  return SNAPSPACE_OK;
}

int snapspace_dimension(const snapspace_session* session) {
  return session ? session->dimension() : SNAPSPACE_BAD_ARGUMENT;
}

int snapspace_solve(snapspace_session* session, const snapspace_options* options,
                    snapspace_report* report) {
  if (!session || !options || !report || !(options->tolerance > 0.0) ||
      !(options->value_scale > 0.0) || !(options->coordinate_scale > 0.0) ||
      options->max_iterations < 1 || options->max_evaluations < 1)
    return SNAPSPACE_BAD_ARGUMENT;
  const Method method = options->method == SNAPSPACE_BFGS ? Method::bfgs : Method::newton;
  const snapspace::online::Termination stop{options->tolerance, options->value_scale,
                                            options->coordinate_scale, options->max_iterations,
                                            options->max_evaluations};
  double* q = session->q.data();
  const Report result = session->posing ? session->posing->solve(q, method, stop)
                                        : session->blending->solve(q, method, stop);
  *report = {static_cast<snapspace_status>(result.status), result.iterations, result.evaluations,
             result.value, result.gradient_norm};
  return SNAPSPACE_OK;
}

int snapspace_value(snapspace_session* session, const double* q, double* value) {
  if (!session || !q || !value) return SNAPSPACE_BAD_ARGUMENT;
  if (!all_finite(q, session->dimension())) return SNAPSPACE_NOT_FINITE;
  double* gradient = session->gradient.data();
  *value = session->posing ? session->posing->value_and_gradient(q, gradient)
                           : session->blending->value_and_gradient(q, gradient);
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
