#pragma once
#include <cstring>

#include "material/arap.h"
#include "material/corotational.h"
#include "material/mooney_rivlin.h"
#include "material/shell.h"
#include "material/shell_arap.h"
#include "material/stable_neo_hookean.h"
#include "material/stvk.h"
#include "material/symmetric_dirichlet.h"

namespace snapspace {

/// The densities, and the only switch over them.
///
/// A density has a name, names of its moduli, and three functions:
///   small_strains(moduli)              its Lame parameters at rest
///   value_and_stress(moduli, G, P)     psi and the first Piola-Kirchhoff stress at G = F - I,
///                                      for a number or a pack
///   curvature(moduli, s)               PrincipalCurvature at signed singular values
/// It is isotropic, stress-free at rest and linear in its moduli: moduli times a volume give the
/// energy of that volume. A density whose sum over several poses collapses may declare a nested
/// Blend, see PoseBlend; otherwise every pose is evaluated.
///
/// The densities of shells are functions of other elements, see ShellDensity. In place of curvature
/// they have hessian(numbers, G, H), and numbers of the rest shape after their moduli.
template <class... Density>
struct DensityList {
  static constexpr int kCount = sizeof...(Density);

  /// Calls act.template operator()<Density>() with the density at an index.
  template <class Act>
  static auto with(int index, Act&& act) {
    return choose<Act, Density...>(index, act);
  }

 private:
  template <class Act, class First, class... Others>
  static auto choose(int index, Act& act) {
    if constexpr (sizeof...(Others) > 0)
      if (index > 0) return choose<Act, Others...>(index - 1, act);
    return act.template operator()<First>();
  }
};

#if !defined(__wasm__)
using Densities =
    DensityList<StableNeoHookean, Corotational, Arap, StVK, SymmetricDirichlet, MooneyRivlin,
                ShellNeoHookean, ShellStVK, ShellNeoHookeanTangent, ShellStVKTangent, ShellArap>;
#else  // no model has a shell whose bending is the tangent, and it would take 20 kB
using Densities = DensityList<StableNeoHookean, Corotational, Arap, StVK, SymmetricDirichlet,
                              MooneyRivlin, ShellNeoHookean, ShellStVK, ShellArap>;
#endif

/// Whether a density is one of shells.
template <class Density>
inline constexpr bool kOfShells = requires { Density::kScaled; };
/// Whether it is evaluated for the stars of vertices, which couple triangles.
template <class Density>
inline constexpr bool kOfStars = requires { Density::kOfStars; };
/// Whether it is one of triangles and hinges.
template <class Density>
inline constexpr bool kOfHinges = kOfShells<Density> && !kOfStars<Density>;

/// The largest number of moduli that a density may have, with the numbers of the rest shape.
inline constexpr int kMaxModuli = 15;

inline const char* material_name(int index) {
  return Densities::with(index, []<class Density>() { return Density::kName; });
}

/// Number of a density's moduli.
inline int material_moduli(int index) {
  return Densities::with(index, []<class Density>() {
    static_assert(Density::kModuli <= kMaxModuli);
    return Density::kModuli;
  });
}

/// Whether the density at an index is one of shells.
inline bool is_of_shells(int index) {
  return Densities::with(index, []<class Density>() { return kOfShells<Density>; });
}

/// Whether the density at an index is evaluated for the stars of vertices.
inline bool is_of_stars(int index) {
  return Densities::with(index, []<class Density>() { return kOfStars<Density>; });
}

/// Sets those numbers of a hinge that depend on its rest angle; for shells with hinges only.
inline void set_rest_angle(int index, double half_tangent, double* numbers) {
  Densities::with(index, [&]<class Density>() {
    if constexpr (kOfHinges<Density>) Density::set_rest_angle(half_tangent, numbers);
  });
}

/// How many of a density's numbers are energies: the others describe the rest shape.
inline int scaled_moduli(int index) {
  return Densities::with(index, []<class Density>() {
    if constexpr (kOfShells<Density>) return Density::kScaled;
    return Density::kModuli;
  });
}

/// Moduli times a volume; the numbers of the rest shape are copied.
inline void scale_moduli(int index, const double* moduli, double volume, double* result) {
  const int count = material_moduli(index), scaled = scaled_moduli(index);
  for (int k = 0; k < count; ++k) result[k] = k < scaled ? volume * moduli[k] : moduli[k];
}

inline const char* modulus_name(int index, int modulus) {
  return Densities::with(index,
                         [modulus]<class Density>() { return Density::kModulusNames[modulus]; });
}

/// Index of the density with this name; -1 if there is none.
inline int material_index(const char* name) {
  for (int index = 0; index < Densities::kCount; ++index)
    if (std::strcmp(name, material_name(index)) == 0) return index;
  return -1;
}

}  // namespace snapspace
