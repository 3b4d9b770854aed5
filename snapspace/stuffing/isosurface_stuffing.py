"""stuff: tetrahedral meshes of implicit shapes, with good dihedral angles."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

import numpy as np
from numpy.typing import ArrayLike, NDArray

from snapspace.arguments import require_positive
from snapspace.mesh.morton_order import morton_order
from snapspace.mesh.tet_mesh import TetMesh
from snapspace.stuffing.bcc_lattice import BccLattice, lattice_around
from snapspace.stuffing.clip import clip_tets
from snapspace.stuffing.cut_points import find_cut_points
from snapspace.stuffing.largest_component import largest_component
from snapspace.stuffing.lattice_warp import lattice_edges, warp_nodes
from snapspace.stuffing.manifold import is_closed_manifold
from snapspace.stuffing.pinches import parted_at_pinches
from snapspace.stuffing.root_finding import FloatArray, ImplicitFunction, evaluate
from snapspace.stuffing.stuffing_stencils import case_numbers, stencil_table

_MOST_CELLS = 50_000_000
# Largest share of the tets in parts that are joined to the others by a point or an edge only.
_CRUMBS = 0.02

#: Called with a part of the work, and two numbers: done and in all.
Progress = Callable[[str, int, int], None]


def stuff(
    implicit: ImplicitFunction,
    lower: ArrayLike,
    upper: ArrayLike,
    cell: float,
    *,
    progress: Progress | None = None,
) -> TetMesh:
    """Fill the inside of an implicit surface with well-shaped tetrahedra of uniform size.

    Isosurface stuffing (Labelle & Shewchuk 2007, "Isosurface Stuffing: Fast Tetrahedral Meshes
    with Good Dihedral Angles", uniform version): nodes of a body-centred cubic lattice that are
    too close to the surface are warped onto it, and the surface clips the lattice. Most of the
    time is spent on evaluating `implicit`, about once for each node in the box.

    Parameters
    ----------
    implicit : callable, (k, 3) -> (k,)
        A continuous function, negative inside. A signed distance is best but not required.
    lower, upper : array_like, (3,)
        Corners of a box that contains the shape.
    cell : float
        Edge length of the lattice cells. Tets in the interior have edges of about 0.9 to 1 times
        `cell` and a volume of cell^3 / 12. Parts thinner than about two cells may get lost.
    progress : callable, optional
        Called with "inside" and the numbers of nodes that are done and in all, then with
        "boundary" and those of steps towards the surface.

    Returns
    -------
    TetMesh
        The largest component, if there are several. Parts that are joined by a point or an edge
        only are separated there, and small ones are left out. Surface vertices lie on the zero set
        of `implicit`. Dihedral angles are above 8 degrees. (The smallest angle seen on smooth
        shapes is 10.6 degrees; in a stress test with random signs and cut points in the worst
        places it is 8.4 degrees.) Mirror planes of the shape that pass through the origin and are
        normal to an axis are mirror planes of the vertices. Vertices and tets are ordered along a
        Morton curve.

    Raises
    ------
    ValueError
        If an argument is invalid, if the shape leaves the box, if nothing is inside, or if
        features as small as the cells make a surface that is not a manifold.
    """
    mesh = stuff_unchecked(implicit, lower, upper, cell, progress=progress)
    if is_closed_manifold(mesh.surface):
        return mesh
    parted = _tidied(*parted_at_pinches(mesh.vertices, mesh.tets))
    kept = len(parted.tets) >= (1.0 - _CRUMBS) * len(mesh.tets)
    if not kept or not is_closed_manifold(parted.surface):
        raise ValueError(
            f"stuff: cell is {cell}, but parts of the shape, or gaps between them, are as small,"
            " so the surface is not a manifold; use a smaller cell"
        )
    return parted


def stuff_unchecked(
    implicit: ImplicitFunction,
    lower: ArrayLike,
    upper: ArrayLike,
    cell: float,
    *,
    progress: Progress | None = None,
) -> TetMesh:
    """Like `stuff`, but the surface may touch itself where features are as small as the cells."""
    lattice = lattice_in(lower, upper, cell)
    points = lattice.points()
    inside_counter = None if progress is None else partial(progress, "inside")
    values = evaluate(implicit, points, inside_counter)
    inside = values < 0.0
    _check_inside(inside, values <= 0.0, lattice)

    tets = lattice.tets_touching(inside)
    boundary_counter = None if progress is None else partial(progress, "boundary")
    cuts = find_cut_points(implicit, points, values, tets, boundary_counter)
    edges = lattice_edges(cuts, corner_count=lattice.corner_count, cell=cell)
    points, signs, cuts = warp_nodes(implicit, points, values, cuts, edges)
    odd = lattice.odd_nodes()
    tets = clip_tets(tets, signs, case_numbers(signs[tets], odd[tets]), stencil_table(), cuts)
    if not len(tets):  # all nodes inside were moved to the surface
        raise ValueError(f"stuff: cell is {cell}, but no part of the shape is as thick")
    return _tidied(np.concatenate([points, cuts.points]), tets)


def lattice_in(lower: ArrayLike, upper: ArrayLike, cell: float) -> BccLattice:
    """The lattice in a box; ValueError for an invalid box or cell, or too many cells."""
    cell = require_positive("stuff", "cell", cell)
    lattice = lattice_around(*_box(lower, upper), cell)
    if np.prod(np.array(lattice.corners, dtype=float)) > _MOST_CELLS:
        raise ValueError(
            f"stuff: cell is {cell}, which makes {lattice.corners} cells in the box, but at most"
            f" {_MOST_CELLS} are allowed; use a larger cell"
        )
    return lattice


def _tidied(vertices: FloatArray, tets: NDArray[np.int64] | NDArray[np.int32]) -> TetMesh:
    """The largest component, along a Morton curve."""
    return TetMesh(*morton_order(*largest_component(vertices, tets)))


def _box(lower: ArrayLike, upper: ArrayLike) -> tuple[FloatArray, FloatArray]:
    corners = []
    for name, value in (("lower", lower), ("upper", upper)):
        corner = np.asarray(value, dtype=np.float64)
        if corner.shape != (3,) or not np.isfinite(corner).all():
            raise ValueError(f"stuff: {name} is {value!r}, but must be three finite numbers")
        corners.append(corner)
    if not (corners[0] < corners[1]).all():
        raise ValueError(f"stuff: lower {lower!r} is not below upper {upper!r} on every axis")
    return corners[0], corners[1]


def _check_inside(
    inside: NDArray[np.bool_], touched: NDArray[np.bool_], lattice: BccLattice
) -> None:
    if not inside.any():
        raise ValueError(
            "stuff: implicit is negative nowhere on the lattice; it must be negative inside the"
            " shape, and cell must be smaller than the shape"
        )
    if touched[lattice.on_border()].any():
        raise ValueError("stuff: the shape leaves the box; move lower and upper outwards")
