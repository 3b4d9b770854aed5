#include "online/residual_probe.h"

#include <algorithm>
#include <memory>

#include "bindings/arrays.h"
#include "energy/material_field.h"
#include "online/element_probe.h"
#include "online/star_probe.h"

namespace snapspace {

namespace {

using online::ElementProbe;
using online::ProbeBody;
using online::ProbePins;
using online::ProbeSample;
using online::ProbeStars;
using online::ResidualProbe;
using online::StarProbe;

void require_all_below(const IndexVectorIn& indices, std::size_t end, const char* message) {
  for (std::size_t i = 0; i < indices.size(); ++i)
    require(indices.data()[i] >= 0 && static_cast<std::size_t>(indices.data()[i]) < end, message);
}

/// A probe with the number of handles whose offsets it reads; 0 for blending.
struct BoundProbe {
  std::unique_ptr<ResidualProbe> probe;
  std::size_t handles;
};

/// Sampled vertices in handles.
struct BoundPins {
  IndexVectorIn pinned, handles;
  VectorIn pulls;
  MatrixIn arms;

  /// @param places  number of vertices that the probe knows
  [[nodiscard]] ProbePins view(std::size_t places) const {
    require(pinned.size() == handles.size() && pinned.size() == pulls.size() &&
                arms.shape(0) == pinned.size() && arms.shape(1) == 3,
            "pinned, handles, pulls (p,) and arms (p, 3) do not match");
    require_all_below(pinned, places, "a pinned vertex is out of range");
    return {static_cast<int>(pinned.size()), pinned.data(), handles.data(), pulls.data(),
            arms.data()};
  }

  /// Number of handles that the pins refer to: the largest index plus one.
  [[nodiscard]] std::size_t count() const {
    std::size_t count = 0;
    for (std::size_t i = 0; i < handles.size(); ++i) {
      require(handles.data()[i] >= 0, "a handle is out of range");
      count = std::max(count, static_cast<std::size_t>(handles.data()[i]) + 1);
    }
    return count;
  }
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

BoundProbe element_probe(const MatrixIn& tau, const TensorIn& modes, const TensorIn& rests,
                         const IndexMatrixIn& tets, const MaterialField& material,
                         const IndexVectorIn& sampled, const VectorIn& weights,
                         const BoundPins& pins) {
  const ProbeBody body = body_of(tau, modes, rests, tets, material);
  require(sampled.size() == weights.size(), "one weight per sampled corner is needed");
  require_all_below(sampled, tau.shape(0), "a sampled corner is out of range");
  const ProbeSample sample{static_cast<int>(sampled.size()), sampled.data(), weights.data()};
  return {std::make_unique<ElementProbe>(body, sample, pins.view(tau.shape(0))), pins.count()};
}

BoundProbe star_probe(const MatrixIn& origins, const SingleTensorIn& modes,
                      const MaterialField& material, const IndexVectorIn& part_stars,
                      const IndexVectorIn& part_samples, const TensorIn& part_vectors,
                      const VectorIn& weights, const BoundPins& pins) {
  const std::size_t poses = origins.shape(0), numbers = origins.shape(1), places = weights.size();
  require(poses >= 1 && places >= 1 && numbers > 3 * places && (numbers - 3 * places) % 9 == 0,
          "origins must be (k, 9 stars + 3 samples), with one weight per sample");
  require(modes.shape(0) == poses && modes.shape(2) == numbers, "modes must be (k, d, numbers)");
  const std::size_t stars = (numbers - 3 * places) / 9;
  require(material.fits(poses * stars), "the material has moduli for a different number of stars");
  require(part_stars.size() == part_samples.size() && part_vectors.shape(0) == poses &&
              part_vectors.shape(1) == part_stars.size() && part_vectors.shape(2) == 3,
          "part_stars, part_samples (p,) and part_vectors (k, p, 3) do not match");
  require_all_below(part_stars, stars, "a star is out of range");
  require_all_below(part_samples, places, "a sample is out of range");
  const ProbeStars given{static_cast<int>(modes.shape(1)),
                         static_cast<int>(poses),
                         static_cast<int>(stars),
                         static_cast<int>(places),
                         origins.data(),
                         modes.data(),
                         material.view(),
                         static_cast<int>(part_stars.size()),
                         part_stars.data(),
                         part_samples.data(),
                         part_vectors.data(),
                         weights.data()};
  return {std::make_unique<StarProbe>(given, pins.view(places)), pins.count()};
}

double norm(BoundProbe& self, const VectorIn& q, const std::optional<TensorIn>& offsets,
            const std::optional<VectorIn>& weights) {
  require(q.size() <= static_cast<std::size_t>(self.probe->dimension()),
          "q has more entries than there are modes");
  if (offsets)
    require(offsets->shape(0) >= self.handles && offsets->shape(1) == 3 && offsets->shape(2) == 4,
            "offsets must be (handles, 3, 4)");
  if (weights)
    require(weights->size() == static_cast<std::size_t>(self.probe->rests()),
            "weights must have one entry per shape at rest");
  return self.probe->norm(q.data(), static_cast<int>(q.size()), offsets ? offsets->data() : nullptr,
                          weights ? weights->data() : nullptr);
}

}  // namespace

void bind_residual_probe(nb::module_& m) {
  nb::class_<BoundProbe>(m, "ResidualProbe",
                         "The gradient of the full objective at sampled "
                         "vertices.")
      .def("norm", &norm, nb::arg("q"), nb::kw_only(), nb::arg("offsets").none() = nb::none(),
           nb::arg("weights").none() = nb::none(),
           "Estimate of the residual's norm, for offsets (h, 3, 4) or weights (k,).");
  m.def(
      "element_probe",
      [](MatrixIn tau, TensorIn modes, TensorIn rests, IndexMatrixIn tets,
         const MaterialField& material, IndexVectorIn sampled, VectorIn weights,
         IndexVectorIn pinned, IndexVectorIn handles, VectorIn pulls, MatrixIn arms) {
        return element_probe(tau, modes, rests, tets, material, sampled, weights,
                             {pinned, handles, pulls, arms});
      },
      nb::arg("tau"), nb::arg("modes"), nb::arg("rests"), nb::arg("tets"), nb::arg("material"),
      nb::arg("sampled"), nb::arg("weights"), nb::kw_only(), nb::arg("pinned"), nb::arg("handles"),
      nb::arg("pulls"), nb::arg("arms"),
      "The probe of a body whose energy is a sum over "
      "independent elements.");
  m.def(
      "star_probe",
      [](MatrixIn origins, SingleTensorIn modes, const MaterialField& material,
         IndexVectorIn part_stars, IndexVectorIn part_samples, TensorIn part_vectors,
         VectorIn weights, IndexVectorIn pinned, IndexVectorIn handles, VectorIn pulls,
         MatrixIn arms) {
        return star_probe(origins, modes, material, part_stars, part_samples, part_vectors, weights,
                          {pinned, handles, pulls, arms});
      },
      nb::arg("origins"), nb::arg("modes"), nb::arg("material"), nb::arg("part_stars"),
      nb::arg("part_samples"), nb::arg("part_vectors"), nb::arg("weights"), nb::kw_only(),
      nb::arg("pinned"), nb::arg("handles"), nb::arg("pulls"), nb::arg("arms"),
      "The probe of an as-rigid-as-possible surface.");
}

}  // namespace snapspace
