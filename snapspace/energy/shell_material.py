"""ShellMaterial: the densities of a shell's triangles and hinges."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..arguments import shown
from ..material import ARAP, Material, StableNeoHookean, StVK
from ..mesh import Body, ShellMesh
from .arap_triangles import KIND, arap_triangles, star_hats

FloatArray = NDArray[np.float64]
Bending = Literal["angle", "tangent"]

#: Measures of bending, with the suffixes of their names in the core.
BENDINGS: dict[Bending, str] = {"angle": "", "tangent": "-tangent"}
#: Materials whose membranes the core has.
MEMBRANES: tuple[type[Material], ...] = (StableNeoHookean, StVK)
#: Materials that shells can be made of.
SHELLS: tuple[type[Material], ...] = (*MEMBRANES, ARAP)


@dataclass(frozen=True, eq=False)
class ShellMaterial:
    """The material of a shell's elements; for tets it is the `Material` itself.

    kind : name of the density in the core
    moduli : (e, 15), mu and lam of the plane and the bending stiffness, each times its power of the
        thickness, and numbers of the rest shape; see core/material/shell.h
    hats : hats of the stars of `ARAP`; None for the one-ring around every vertex
    """

    kind: str
    moduli: FloatArray
    hats: _core.StarHats | None = None

    @cached_property
    def core(self) -> _core.Material:
        """The densities in the compiled core."""
        return _core.Material(self.kind, self.moduli, self.hats)

    @property
    def uniform(self) -> bool:
        """Whether all elements have the same numbers: never."""
        return False

    def check_tets(self, count: int, who: str) -> None:
        """ValueError unless there is one row for each of `count` elements."""
        if len(self.moduli) != count:
            raise ValueError(
                f"{who}: the material has {len(self.moduli)} elements, but {count} are needed"
            )

    def of_tets(self, elements: NDArray[np.integer[Any]]) -> ShellMaterial:
        """The material of some elements (r,), in their order."""
        return ShellMaterial(self.kind, np.ascontiguousarray(self.moduli[elements]))

    def __reduce__(self) -> tuple[Any, ...]:
        # cached properties are left out: the compiled material cannot be pickled
        return ShellMaterial, (self.kind, self.moduli, self.hats)


def element_material(
    mesh: Body, material: Material, *, bending: Bending = "angle", who: str
) -> Material | ShellMaterial:
    """The material of a body's elements: that of its tets, or of its triangles and hinges.

    Raises
    ------
    ValueError
        For a shell of a material without a membrane, for an unknown measure of bending, or for one
        other than the default with `ARAP`.
    """
    if bending not in tuple(BENDINGS):
        raise ValueError(
            f"{who}: unknown bending {shown(bending)}; known are {', '.join(BENDINGS)}"
        )
    if not isinstance(mesh, ShellMesh):
        return material
    poses = mesh.vertices[None]
    hats = star_hats(mesh, poses, material) if isinstance(material, ARAP) else None
    return shell_materials(mesh, poses, material, bending=bending, hats=hats, who=who)[0]


def shell_materials(
    mesh: ShellMesh,
    poses: FloatArray,
    material: Material,
    *,
    bending: Bending = "angle",
    hats: _core.StarHats | None = None,
    who: str,
) -> list[ShellMaterial]:
    """The materials of a shell's elements with each of several poses (k, n, 3) as the rest shape.

    With `ARAP` the elements are the triangles alone, with the `hats` of the stars. Moduli are those
    in the mesh itself. Bending vanishes where a triangle collapses, relative to the mean areas of
    all poses, so that blends of energies collapse (core/energy/shell_poses.h).

    Raises
    ------
    ValueError
        For a material without a membrane, or a measure of bending for `ARAP`.
    """
    if isinstance(material, ARAP):
        if bending != "angle":
            raise ValueError(f"{who}: ARAP has no hinges, so bending cannot be '{bending}'")
        return [ShellMaterial(KIND, rows, hats) for rows in arap_triangles(mesh, poses, material)]
    _check_membrane(material, who)
    count = len(mesh.triangles)
    moduli = np.zeros((len(mesh.elements), 3))
    moduli[:count, 0] = material.mu * mesh.thickness
    moduli[:count, 1] = plane_lam(material) * mesh.thickness
    sides = mesh.areas[mesh.hinge_triangles]
    shares = sides * rigidities(mesh, material)[mesh.hinge_triangles]
    moduli[count:, 2] = shares.sum(axis=1) / sides.sum(axis=1)
    kind = f"shell-{material.kind}{BENDINGS[bending]}"
    rows = _core.shell_moduli(np.ascontiguousarray(poses), mesh.elements, kind, moduli)
    return [ShellMaterial(kind, row) for row in rows]


def is_of_stars(mesh: Body, material: Material) -> bool:
    """Whether the elements are stars, those of an as-rigid-as-possible surface."""
    return isinstance(mesh, ShellMesh) and isinstance(material, ARAP)


def _check_membrane(material: Material, who: str) -> None:
    if isinstance(material, MEMBRANES):
        return
    *names, last = (one.__name__ for one in SHELLS)
    raise ValueError(
        f"{who}: a shell cannot be made of {material.title}, which has no such form; use "
        f"{', '.join(names)} or {last}"
    )


def rigidities(mesh: ShellMesh, material: Material) -> FloatArray:
    """Bending stiffness D = (2 mu + lam') thickness^3 / 12 of a plate, for each triangle, (f,).

    For `ARAP` it is that of equilateral triangles, (3/4)^(1/2) mu * thickness * area: an
    as-rigid-as-possible surface resists bending by the width of its triangles.
    """
    if isinstance(material, ARAP):
        return np.asarray(np.sqrt(0.75) * material.mu * mesh.thickness * mesh.areas)
    one = (2.0 * material.mu + plane_lam(material)) * np.power(mesh.thickness, 3) / 12.0
    return np.broadcast_to(one, len(mesh.triangles))


def plane_lam(material: Material) -> FloatArray:
    """The first Lame parameter lam' in plane stress, 2 lam mu / (lam + 2 mu).

    With it and mu, small strains in the plane have the stiffness of a thin sheet whose faces are
    free (Timoshenko, Goodier, Theory of Elasticity).
    """
    lam, mu = material.lam, material.mu
    return np.asarray(2.0 * lam * mu / (lam + 2.0 * mu), np.float64)
