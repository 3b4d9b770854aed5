// The functions of snapspace_online.h for residuals.
#include <algorithm>
#include <cstdint>
#include <memory>

#include "online/element_probe.h"
#include "online/session.h"
#include "online/star_probe.h"

using snapspace::TetMaterial;
using snapspace::online::ElementProbe;
using snapspace::online::ProbeBody;
using snapspace::online::ProbePins;
using snapspace::online::ProbeSample;
using snapspace::online::ProbeStars;
using snapspace::online::read_material;
using snapspace::online::StarProbe;

namespace {

bool all_below(const int* indices, std::size_t count, int end) {
  return std::all_of(indices, indices + count, [end](int i) { return 0 <= i && i < end; });
}

bool has_arrays(const snapspace_probe& probe) {
  return probe.corners >= 4 && probe.tets >= 1 && probe.rests >= 1 && probe.samples >= 1 &&
         probe.tau && probe.modes && probe.rest_shapes && probe.tet_corners && probe.sampled &&
         probe.weights;
}

bool has_arrays(const snapspace_star_probe& probe) {
  return probe.stars >= 1 && probe.rests >= 1 && probe.samples >= 1 && probe.parts >= 1 &&
         probe.origins && probe.modes && probe.part_stars && probe.part_samples &&
         probe.part_vectors && probe.weights;
}

/// Whether rests and pins match the session; pins are indices below `places`.
template <class Probe>
bool fits(const snapspace_session& session, const Probe& probe, int places) {
  const int handles = session.blends() ? 0 : static_cast<int>(session.state.size() / 12);
  const int rests = session.blends() ? static_cast<int>(session.state.size()) : 1;
  if (probe.rests != rests || probe.pins < 0) return false;
  return probe.pins == 0 || (probe.pinned && probe.pin_handles && probe.pulls && probe.arms &&
                             all_below(probe.pinned, probe.pins, places) &&
                             all_below(probe.pin_handles, probe.pins, handles));
}

template <class Probe>
ProbePins pins_of(const Probe& probe) {
  return {probe.pins, probe.pinned, probe.pin_handles, probe.pulls, probe.arms};
}

}  // namespace

int snapspace_set_probe(snapspace_session* session, const snapspace_probe* probe) {
  if (!session || !probe || !has_arrays(*probe) || !fits(*session, *probe, probe->corners) ||
      !all_below(probe->tet_corners, 4 * std::size_t(probe->tets), probe->corners) ||
      !all_below(probe->sampled, probe->samples, probe->corners))
    return SNAPSPACE_BAD_ARGUMENT;
  TetMaterial material;
  const int code = read_material(probe->material, probe->tets, material);
  if (code != SNAPSPACE_OK) return code;
  if (snapspace::is_of_stars(material.kind)) return SNAPSPACE_BAD_ARGUMENT;
  const ProbeBody body = {static_cast<int>(session->q.size()),
                          probe->corners,
                          probe->tets,
                          probe->rests,
                          probe->tau,
                          probe->modes,
                          probe->rest_shapes,
                          probe->tet_corners,
                          material};
  const ProbeSample sample = {probe->samples, probe->sampled, probe->weights};
  session->probe = std::make_unique<ElementProbe>(body, sample, pins_of(*probe));
  return SNAPSPACE_OK;
}

int snapspace_set_star_probe(snapspace_session* session, const snapspace_star_probe* probe) {
  if (!session || !probe || !has_arrays(*probe) || !fits(*session, *probe, probe->samples) ||
      !all_below(probe->part_stars, probe->parts, probe->stars) ||
      !all_below(probe->part_samples, probe->parts, probe->samples))
    return SNAPSPACE_BAD_ARGUMENT;
  TetMaterial material;
  const int code = read_material(probe->material, probe->rests * probe->stars, material);
  if (code != SNAPSPACE_OK) return code;
  if (!snapspace::is_of_stars(material.kind)) return SNAPSPACE_BAD_ARGUMENT;
  const ProbeStars stars = {static_cast<int>(session->q.size()),
                            probe->rests,
                            probe->stars,
                            probe->samples,
                            probe->origins,
                            probe->modes,
                            material,
                            probe->parts,
                            probe->part_stars,
                            probe->part_samples,
                            probe->part_vectors,
                            probe->weights};
  session->probe = std::make_unique<StarProbe>(stars, pins_of(*probe));
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
