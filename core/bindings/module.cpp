#include "bindings/arrays.h"
#include "simd/lanes.h"

namespace snapspace {
void bind_energy(nb::module_& m);
void bind_cholesky(nb::module_& m);
void bind_multigrid(nb::module_& m);
void bind_rows(nb::module_& m);
void bind_snapshots(nb::module_& m);
void bind_systems(nb::module_& m);
void bind_soft_modes(nb::module_& m);
void bind_linear_response(nb::module_& m);
void bind_polish(nb::module_& m);
void bind_fitting(nb::module_& m);
void bind_reduction(nb::module_& m);
void bind_online(nb::module_& m);
void bind_cubature(nb::module_& m);
void bind_residual_probe(nb::module_& m);
void bind_measure(nb::module_& m);
}  // namespace snapspace

NB_MODULE(SNAPSPACE_MODULE, m) {
  // What outlives the interpreter is not lost memory, and users should not read about it.
  nanobind::set_leak_warnings(false);
  m.doc() = "The loops of snapspace that must be fast.";
  m.attr("lane_count") = snapspace::kWideLanes;
  snapspace::bind_energy(m);
  snapspace::bind_cholesky(m);
  snapspace::bind_multigrid(m);
  snapspace::bind_rows(m);
  snapspace::bind_snapshots(m);
  snapspace::bind_systems(m);
  snapspace::bind_soft_modes(m);
  snapspace::bind_linear_response(m);
  snapspace::bind_polish(m);
  snapspace::bind_fitting(m);
  snapspace::bind_reduction(m);
  snapspace::bind_online(m);
  snapspace::bind_cubature(m);
  snapspace::bind_residual_probe(m);
  snapspace::bind_measure(m);
}
