#include "bindings/arrays.h"
#include "lanes/in_lanes.h"

namespace snapspace {
void bind_energy(nb::module_& m);
void bind_stars(nb::module_& m);
void bind_cholesky(nb::module_& m);
void bind_face_tree(nb::module_& m);
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

namespace {

void bind_all(nb::module_& m) {
  // Objects that outlive the interpreter are not leaks, so users should not see warnings of leaks.
  nb::set_leak_warnings(false);
  m.doc() = "The compiled core: the computations of snapspace that must be fast.";
  m.attr("lane_count") = samples_together(Packing::lanes);
  bind_stars(m);
  bind_energy(m);
  bind_cholesky(m);
  bind_face_tree(m);
  bind_multigrid(m);
  bind_rows(m);
  bind_snapshots(m);
  bind_systems(m);
  bind_soft_modes(m);
  bind_linear_response(m);
  bind_polish(m);
  bind_fitting(m);
  bind_reduction(m);
  bind_online(m);
  bind_cubature(m);
  bind_residual_probe(m);
  bind_measure(m);
}

}  // namespace

}  // namespace snapspace

// The same object is linked into the module of each level, and Python calls the function with the
// module's name.
NB_MODULE(_core_baseline, m) { snapspace::bind_all(m); }
NB_MODULE(_core_v3, m) { snapspace::bind_all(m); }
NB_MODULE(_core_v4, m) { snapspace::bind_all(m); }
