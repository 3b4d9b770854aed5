// The functions of snapspace_online.h for residuals.
#include <algorithm>
#include <cstdint>
#include <memory>

#include "online/session.h"

using snapspace::TetMaterial;
using snapspace::online::ProbeBody;
using snapspace::online::read_material;
using snapspace::online::ResidualProbe;

namespace {

bool all_below(const int* indices, std::size_t count, int end) {
  return std::all_of(indices, indices + count, [end](int i) { return 0 <= i && i < end; });
}

bool has_arrays(const snapspace_probe& probe) {
  if (probe.corners < 4 || probe.tets < 1 || probe.rests < 1 || probe.samples < 1 || probe.pins < 0)
    return false;
  if (!probe.tau || !probe.modes || !probe.rest_shapes || !probe.tet_corners || !probe.sampled ||
      !probe.weights)
    return false;
  return probe.pins == 0 || (probe.pinned && probe.pin_handles && probe.pulls && probe.arms);
}

/// Whether rests and pins match the session, and all indices are in range.
bool fits(const snapspace_session& session, const snapspace_probe& probe) {
  const int handles = session.blends() ? 0 : static_cast<int>(session.state.size() / 12);
  const int rests = session.blends() ? static_cast<int>(session.state.size()) : 1;
  return probe.rests == rests &&
         all_below(probe.tet_corners, 4 * std::size_t(probe.tets), probe.corners) &&
         all_below(probe.sampled, probe.samples, probe.corners) &&
         all_below(probe.pinned, probe.pins, probe.corners) &&
         all_below(probe.pin_handles, probe.pins, handles);
}

}  // namespace

int snapspace_set_probe(snapspace_session* session, const snapspace_probe* probe) {
  if (!session || !probe || !has_arrays(*probe) || !fits(*session, *probe))
    return SNAPSPACE_BAD_ARGUMENT;
  TetMaterial material;
  const int code = read_material(probe->material, probe->tets, material);
  if (code != SNAPSPACE_OK) return code;
  const ProbeBody body = {static_cast<int>(session->q.size()),
                          probe->corners,
                          probe->tets,
                          probe->rests,
                          probe->tau,
                          probe->modes,
                          probe->rest_shapes,
                          probe->tet_corners,
                          material};
  session->probe = std::make_unique<ResidualProbe>(
      body, snapspace::online::ProbeSample{probe->samples, probe->sampled, probe->weights},
      snapspace::online::ProbePins{probe->pins, probe->pinned, probe->pin_handles, probe->pulls,
                                   probe->arms});
  return SNAPSPACE_OK;
}

int snapspace_residual(snapspace_session* session, double* residual) {
  if (!session || !residual) return SNAPSPACE_BAD_ARGUMENT;
  if (!session->probe) return SNAPSPACE_WRONG_KIND;
  const double* state = session->state.data();
  *residual = session->probe->norm(session->q.data(), session->dimension(),
                                   session->blends() ? nullptr : state,
                                   session->blends() ? state : nullptr);
  return SNAPSPACE_OK;
}
