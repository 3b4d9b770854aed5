#include "bindings/arrays.h"
#include "bindings/released_gil.h"
#include "snapshots/find_soft_modes.h"

namespace snapspace {

void bind_soft_modes(nb::module_& m) {
  nb::class_<SoftModes>(
      m, "SoftModes",
      "Soft modes of a posing system for the seed of L-BFGS: the lowest generalised eigenvectors "
      "of its Hessian at rest with respect to the scalar matrix. The scalar factor mistakes these "
      "deformations for stiff ones.")
      .def(
          "__init__",
          [](SoftModes* self, const PosingSystem& system) {
            const ReleasedGil released;
            new (self) SoftModes(find_soft_modes(system));
          },
          nb::arg("system"))
      .def(
          "modes",
          [](const SoftModes& self, const PosingSystem& system) {
            require(self.size() == static_cast<std::size_t>(system.size()),
                    "the modes belong to another system");
            DoublesOut modes = new_array<double>({SoftModes::kCount, self.size()});
            std::vector<double> mode(self.size());
            for (int k = 0; k < SoftModes::kCount; ++k) {
              for (std::size_t i = 0; i < self.size(); ++i) mode[i] = self.entry(i, k);
              system.numbering.to_external(mode.data(), modes.data() + k * self.size());
            }
            return modes;
          },
          nb::arg("system"),
          "Modes v (8, 3n) with v . A v = 1 for the scalar matrix A of the system.")
      .def_prop_ro(
          "weights",
          [](const SoftModes& self) {
            std::vector<double> weights;
            for (int k = 0; k < SoftModes::kCount; ++k) weights.push_back(self.weight(k));
            return weights;
          },
          "The 8 weights of the modes in the seed; zero where no mode was found.");
}

}  // namespace snapspace
