"""Filling a closed surface with tets of a lattice, in seconds."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import require_count, require_function
from ..mesh import TetMesh
from ..mesh.tet_search import closest_boundary_faces
from ..stuffing import Progress, stuff
from .closed_gaps import notice_joined, wrong_loops
from .closed_input import check_share, closed_input
from .enclosed_solid import EnclosedSolid
from .graded_tets import graded_tets

# Vertices of the surface farther than this from tets of one size, in edge lengths, are in a lost
# part.
_LOST = 1.0
# Factors of the edge length, tried in turn if parts are too thin.
_SCALES = (1.0, 0.8)


def stuff_surface(
    vertices: ArrayLike,
    faces: ArrayLike,
    *,
    edge_length: float = 0.025,
    mend: bool = False,
    most_closed: int = 4,
    progress: Progress | None = None,
) -> TetMesh:
    """Fills a closed triangle surface with tets of one size, or smaller ones where it is thin.

    Parameters
    ----------
    vertices : array_like, (s, 3)
        Points of the surface.
    faces : array_like of int, (f, 3)
        Closed and consistently oriented, outward or inward. Parts may overlap, also if some of them
        are inside out.
    edge_length : float, default 0.025
        Length of the longest edges inside, as a share of the diagonal of the surface's bounding
        box. If parts are too thin for that, 0.8 of it is tried. Then cells are halved up to three
        times, only where the tets lose a part of the surface, or touch each other.
    mend : bool, default False
        Mend a surface that is not closed or not consistently oriented, see `mend_surface`. A
        `MeshNotice` says what was done. Separate parts that stay open and have less than half of
        the area are left out. If more stays open, the surface is refused.
    most_closed : int, default 4
        Largest number of narrow gaps or holes that the tets may close. For a pose that others are
        blended with, 0 is safer: where another pose opens such a gap, tets would be torn apart.
        With 0, separate parts that overlap are refused, because their number is not known.
    progress : callable, optional
        Called with "inside" and two numbers of points, done and in all; then with "boundary" and
        the numbers of steps towards the surface. Called again for each shorter edge that is tried.

    Returns
    -------
    TetMesh
        Its boundary has its own vertices, which lie on the surface; sharp edges are cut off within
        an edge length. No vertex of the surface that is not inside is farther from it than that. A
        `MeshNotice` says if gaps or holes narrower than the tets are closed, and if separate parts
        overlap, which become one solid. Dihedral angles are over 8 degrees for
        tets of one size; otherwise the smallest is usually 6 to 14 degrees, and that of one tet in
        a hundred 19 to 22. The same input gives the same tets.

    Raises
    ------
    ValueError
        For wrong shapes or types, coordinates that are not finite, an index out of range, no faces,
        a surface that is not closed, not consistently oriented or encloses no volume, options out
        of range, or if parts or gaps are too thin for the edge length, or touch each other; use
        `fill_surface` for such surfaces.

    Notes
    -----
    Isosurface stuffing (Labelle and Shewchuk 2007, see `stuffing.stuff`) of the signed distance. It
    takes seconds where `fill_surface`, which follows the surface within a tolerance, may take
    minutes.
    """
    surface = closed_input(vertices, faces, who="stuff_surface", mend=mend)
    check_share(edge_length, "edge_length", largest=0.5, who="stuff_surface")
    most_closed = require_count("stuff_surface", "most_closed", most_closed, at_least=0)
    require_function("stuff_surface", "progress", progress)
    solid = EnclosedSolid(surface)
    if solid.is_joined and most_closed == 0:
        raise ValueError(
            "stuff_surface: separate parts of the surface overlap, so it is not known whether tets "
            "close a gap, but most_closed is 0; use fill_surface"
        )
    try:
        mesh = _filled(solid, edge_length, most_closed, progress)
    except ValueError as error:
        raise ValueError(
            f"stuff_surface: edge_length is {edge_length:g} of the diagonal, too long for thin "
            f"parts or gaps of the surface, {error}; choose a shorter one, or use fill_surface"
        ) from None
    notice_joined(mesh, solid)
    return TetMesh(mesh.vertices * surface.diagonal + surface.center, mesh.tets)


def _filled(
    solid: EnclosedSolid,
    cell: float,
    most_closed: int,
    progress: Progress | None,
) -> TetMesh:
    """Tets of one size, if they lose no part; smaller ones in some places if that is better."""
    even = _even_tets(solid, cell, progress)
    wrong = math.inf if even is None else wrong_loops(even, solid)
    if even is not None and wrong == 0:
        return even
    try:
        graded = graded_tets(solid, cell, most_closed=most_closed, progress=progress)
    except ValueError:
        if even is not None and wrong <= most_closed:
            return even
        raise
    return even if even is not None and wrong <= wrong_loops(graded, solid) else graded


def _even_tets(
    solid: EnclosedSolid, edge_length: float, progress: Progress | None
) -> TetMesh | None:
    """Tets of one size, with as few wrong loops as possible; None if they lose parts."""
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    exposed = solid.vertices[solid.exposed]
    found: list[TetMesh] = []
    for scale in _SCALES:
        cell = scale * edge_length
        try:
            mesh = stuff(solid.distance, low, high, cell, progress=progress)
        except ValueError:  # the boundary touches itself
            continue
        _, distances = closest_boundary_faces(mesh, exposed, limit=_LOST * cell)
        if np.isfinite(distances).all():
            found.append(mesh)
            if wrong_loops(mesh, solid) == 0:
                break
    return min(found, key=lambda mesh: wrong_loops(mesh, solid), default=None)
