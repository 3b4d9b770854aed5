"""Parts: stiffer and softer parts of a body that a page has painted."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..material import Material
from ..mesh import Body
from .messages import PartChoice
from .surface_regions import SurfaceRegions

FloatArray = NDArray[np.float64]
Mask = NDArray[np.bool_]

#: Beyond these limits the rounding errors of stiff parts exceed the forces of soft ones.
LEAST_FACTOR, MOST_FACTOR = 1e-4, 1e4
#: A tet belongs to a part if at least this many of its corners do.
CORNERS = 3


def part_factors(
    parts: Sequence[PartChoice], mesh: Body, regions: SurfaceRegions | None
) -> FloatArray | None:
    """The stiffness factor of each tet, (m,); where parts overlap, the last one counts.

    Parameters
    ----------
    parts : sequence of PartChoice
    mesh : TetMesh or ShellMesh
    regions : SurfaceRegions or None
        The regions of the body's own surface, if it has one; the parts then have its vertices.

    Returns
    -------
    ndarray or None
        None without parts.

    Raises
    ------
    ValueError
        For a factor out of range, a name that is empty or used twice, a vertex index out of range,
        or a part without tets. The message names the part.
    """
    if not parts:
        return None
    factors = np.ones(len(mesh.cells))
    names: set[str] = set()
    for part in parts:
        _check(part, names)
        names.add(part.name)
        factors[_tets_in(part, mesh, regions)] = part.factor
    return factors


def with_factors(material: Material, factors: FloatArray | None) -> Material:
    """The material with the moduli of each tet times its factor; densities are linear in moduli."""
    if factors is None:
        return material
    moduli = {name: getattr(material, name) * factors for name in material.names()}
    return material.with_moduli(moduli)


def _check(part: PartChoice, names: set[str]) -> None:
    if not part.name.strip():
        raise ValueError("a part has no name; give it one")
    if part.name in names:
        raise ValueError(f"the name '{part.name}' is used by two parts; rename one")
    if not LEAST_FACTOR <= part.factor <= MOST_FACTOR:
        raise ValueError(
            f"part '{part.name}' has the factor {part.factor:g}, but it must be from "
            f"{LEAST_FACTOR:g} to {MOST_FACTOR:g}"
        )


def _tets_in(part: PartChoice, mesh: Body, regions: SurfaceRegions | None) -> Mask:
    count = len(mesh.vertices) if regions is None else regions.surface_vertices
    chosen = np.zeros(count, np.bool_)
    vertices = np.asarray(part.vertices, np.int64)
    wrong = vertices[(vertices < 0) | (vertices >= count)]
    if wrong.size:
        raise ValueError(
            f"part '{part.name}' has vertex index {wrong[0]}, but there are {count} vertices"
        )
    chosen[vertices] = True
    inside = chosen if regions is None else regions.through(chosen)
    tets: Mask = inside[mesh.cells].sum(axis=1) >= CORNERS
    if not tets.any():
        raise ValueError(
            f"part '{part.name}' has no tet: three of a tet's corners must be in it; choose a "
            "larger part, or delete it"
        )
    return tets
