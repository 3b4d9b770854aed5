"""Regions of a material in a problem file: parts of the body with other moduli."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..material import Material
from ..mesh import Body
from .json_entries import as_number, as_object, within
from .moduli_entries import NAMES, Value, moduli_of
from .place_entries import Mask, in_places, listed

FloatArray = NDArray[np.float64]

#: With more different sets of moduli than this, lists are written instead of regions.
MOST_REGIONS = 16
#: Number of corners in the vertices of a region that make a tet a part of it.
_CORNERS = 3
_PLACES = {"boxes", "spheres", "vertices", "tets"}
_FACTOR = "factor"


def with_regions(material: Material, regions: Sequence[Any], mesh: Body) -> Material:
    """The material with other moduli in regions; later regions win.

    Parameters
    ----------
    material : Material
    regions : sequence of objects
        Each region has a place: "boxes", "spheres" and "vertices", as for handles, or a list of
        "tets". It also has either moduli, as for the material itself, or a "factor" > 0 for all
        moduli. A tet is in a region if its centroid is in a box or sphere, or three of its corners
        are among the vertices, or it is listed. For a shell, "tets" means triangles.
    mesh : TetMesh or ShellMesh

    Raises
    ------
    ValueError
        For a mistyped entry, values out of range, or a region without tets; the message begins with
        the region.
    """
    if not regions:
        return material
    kind, count = type(material), len(mesh.cells)
    moduli = {name: np.broadcast_to(getattr(material, name), count).copy() for name in kind.names()}
    known = {*_PLACES, _FACTOR, *NAMES, *kind.names()}
    for number, item in enumerate(regions):
        place = f"material.regions[{number}]"
        region = as_object(item, place, known=known)
        with within(place):
            inside = _tets_in(region, mesh)
            new = {key: value for key, value in region.items() if key not in _PLACES}
            for name, value in _moduli_of(new, kind, moduli, inside).items():
                moduli[name][inside] = value
            material = material.with_moduli(moduli)
    return material


def regions_content(
    rows: FloatArray, names: Sequence[str]
) -> tuple[FloatArray | None, list[dict[str, Any]]]:
    """Moduli (m, k) as the set (k,) of most tets, and regions with the others; see `with_regions`.

    The set is None if there are too many different ones.
    """
    different, which, counts = np.unique(rows, axis=0, return_inverse=True, return_counts=True)
    if len(different) > MOST_REGIONS:
        return None, []
    most = int(counts.argmax())
    base, regions = different[most], []
    for number, row in enumerate(different):
        if number != most:
            values = {n: float(row[j]) for j, n in enumerate(names) if row[j] != base[j]}
            tets = np.flatnonzero(which.reshape(-1) == number)
            regions.append({"tets": tets.tolist(), **values})
    return base, regions


def _tets_in(region: dict[str, Any], mesh: Body) -> Mask:
    inside = in_places(region, mesh.vertices[mesh.cells].mean(axis=1))
    inside |= listed(region, "tets", "a tet", count=len(mesh.cells))
    vertices = listed(region, "vertices", "a vertex", count=len(mesh.vertices))
    inside |= vertices[mesh.cells].sum(axis=1) >= _CORNERS
    if not inside.any():
        raise ValueError("it contains no tet; widen its boxes or spheres")
    return inside


def _moduli_of(
    entries: dict[str, Any], kind: type[Material], moduli: dict[str, FloatArray], inside: Mask
) -> dict[str, Value]:
    """The new moduli of a region, numbers or one per tet inside."""
    if not entries:
        raise ValueError(f"it changes nothing; give {' and '.join(kind.names())}, or factor")
    if _FACTOR not in entries:
        return moduli_of(entries, kind, of_each=as_number)
    if len(entries) > 1:
        raise ValueError(f"give factor or '{min(entries.keys() - {_FACTOR})}', not both")
    factor = as_number(entries[_FACTOR], _FACTOR)
    if not (np.isfinite(factor) and factor > 0):
        raise ValueError(f"factor is {factor}, but it must be positive")
    return {name: factor * values[inside] for name, values in moduli.items()}
