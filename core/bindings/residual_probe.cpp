#include "online/residual_probe.h"

#include "bindings/arrays.h"
#include "energy/material_field.h"

namespace snapspace {

namespace {

using online::ProbeBody;
using online::ProbePins;
using online::ProbeSample;
using online::ResidualProbe;

void require_all_below(const IndexVectorIn& indices, std::size_t end, const char* message) {
  for (std::size_t i = 0; i < indices.size(); ++i)
    require(indices.data()[i] >= 0 && static_cast<std::size_t>(indices.data()[i]) < end, message);
}

/// A probe with the number of handles whose offsets it reads; 0 for blending.
struct BoundProbe {
  ResidualProbe probe;
  std::size_t handles;
};

ProbeBody body_of(const MatrixIn& tau, const TensorIn& modes, const TensorIn& rests,
                  const IndexMatrixIn& tets, const MaterialField& material) {
  const std::size_t corners = tau.shape(0);
  require(tau.shape(1) == 3 && modes.shape(1) == corners && modes.shape(2) == 3 &&
              rests.shape(0) >= 1 && rests.shape(1) == corners && rests.shape(2) == 3,
          "tau (c, 3), modes (d, c, 3) and rests (k, c, 3) do not match");
  require(tets.shape(1) == 4, "tets must be (t, 4)");
  require_below(tets, corners, "a tet has a corner out of range");
  require(material.fits(tets.shape(0)), "the material has moduli for a different number of tets");
  return {static_cast<int>(modes.shape(0)),
          static_cast<int>(corners),
          static_cast<int>(tets.shape(0)),
          static_cast<int>(rests.shape(0)),
          tau.data(),
          modes.data(),
          rests.data(),
          tets.data(),
          material.view()};
}

double norm(BoundProbe& self, const VectorIn& q, const std::optional<TensorIn>& offsets,
            const std::optional<VectorIn>& weights) {
  require(q.size() <= static_cast<std::size_t>(self.probe.dimension()),
          "q has more entries than there are modes");
  if (offsets)
    require(offsets->shape(0) >= self.handles && offsets->shape(1) == 3 && offsets->shape(2) == 4,
            "offsets must be (handles, 3, 4)");
  if (weights)
    require(weights->size() == static_cast<std::size_t>(self.probe.rests()),
            "weights must have one entry per shape at rest");
  return self.probe.norm(q.data(), static_cast<int>(q.size()), offsets ? offsets->data() : nullptr,
                         weights ? weights->data() : nullptr);
}

}  // namespace

void bind_residual_probe(nb::module_& m) {
  nb::class_<BoundProbe>(m, "ResidualProbe", "The full objective's gradient at sampled vertices.")
      .def(
          "__init__",
          [](BoundProbe* self, MatrixIn tau, TensorIn modes, TensorIn rests, IndexMatrixIn tets,
             const MaterialField& material, IndexVectorIn sampled, VectorIn sample_weights,
             IndexVectorIn pinned, IndexVectorIn handles, VectorIn pulls, MatrixIn arms) {
            const ProbeBody body = body_of(tau, modes, rests, tets, material);
            require(sampled.size() == sample_weights.size(),
                    "one weight per sampled corner is needed");
            require_all_below(sampled, tau.shape(0), "a sampled corner is out of range");
            require(pinned.size() == handles.size() && pinned.size() == pulls.size() &&
                        arms.shape(0) == pinned.size() && arms.shape(1) == 3,
                    "pinned, handles, pulls (p,) and arms (p, 3) do not match");
            require_all_below(pinned, tau.shape(0), "a pinned corner is out of range");
            std::size_t count = 0;
            for (std::size_t i = 0; i < handles.size(); ++i) {
              require(handles.data()[i] >= 0, "a handle is out of range");
              count = std::max(count, static_cast<std::size_t>(handles.data()[i]) + 1);
            }
            const ProbeSample sample{static_cast<int>(sampled.size()), sampled.data(),
                                     sample_weights.data()};
            const ProbePins pins{static_cast<int>(pinned.size()), pinned.data(), handles.data(),
                                 pulls.data(), arms.data()};
            new (self) BoundProbe{ResidualProbe(body, sample, pins), count};
          },
          nb::arg("tau"), nb::arg("modes"), nb::arg("rests"), nb::arg("tets"), nb::arg("material"),
          nb::arg("sampled"), nb::arg("sample_weights"), nb::kw_only(), nb::arg("pinned"),
          nb::arg("handles"), nb::arg("pulls"), nb::arg("arms"))
      .def("norm", &norm, nb::arg("q"), nb::kw_only(), nb::arg("offsets").none() = nb::none(),
           nb::arg("weights").none() = nb::none(),
           "Estimate of the residual's norm, for offsets (h, 3, 4) or weights (k,).");
}

}  // namespace snapspace
