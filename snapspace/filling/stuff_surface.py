"""Filling a closed surface with tets of one size, in seconds."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..arguments import require_function
from ..mesh import MeshNotice, TetMesh
from ..mesh.arrays import FloatArray
from ..mesh.signed_distance import SignedDistance
from ..mesh.tet_search import closest_boundary_faces
from ..notice import notify
from ..stopping import check_stop
from ..stuffing import Progress, stuff
from .closed_gaps import notice_closed_gaps
from .closed_input import ClosedInput, check_share, closed_input
from .lost_tips import are_tips

# Vertices of the surface farther than this from the tets, in edge lengths, are in a lost part; the
# second number is the limit for a lost tip.
_LOST, _TIP = 1.0, 3.0
# Factors of the edge length, tried in turn if parts are too thin.
_SCALES = (1.0, 0.8, 0.6)


def stuff_surface(
    vertices: ArrayLike,
    faces: ArrayLike,
    *,
    edge_length: float = 0.025,
    mend: bool = False,
    progress: Progress | None = None,
) -> TetMesh:
    """Fills a closed triangle surface with well-shaped tets of one size.

    Parameters
    ----------
    vertices : array_like, (s, 3)
        Points of the surface.
    faces : array_like of int, (f, 3)
        Closed and consistently oriented, outward or inward; without self-intersections.
    edge_length : float, default 0.025
        Length of the longest edges inside, as a share of the diagonal of the surface's bounding
        box. If parts are too thin for that, 0.8 and 0.6 of it are tried.
    mend : bool, default False
        Mend a surface that is not closed or not consistently oriented, see `mend_surface`. A
        `MeshNotice` says what was done. A surface that stays open is refused.
    progress : callable, optional
        Called with "inside" and two numbers of points, done and in all; then with "boundary" and
        the numbers of steps towards the surface. Called again for each shorter edge that is tried.

    Returns
    -------
    TetMesh
        Its boundary has its own vertices, which lie on the surface; sharp edges are cut off within
        an edge length. Thin tips that no tried edge length reaches are left out if they have at
        most one in a hundred of the vertices and are up to three edge lengths long; the shortest
        edge that reaches the rest is used, and a `MeshNotice` says so. Another one says if gaps or
        holes narrower than the tets are closed. Dihedral angles are over 8 degrees. The same input
        gives the same tets.

    Raises
    ------
    ValueError
        For wrong shapes or types, coordinates that are not finite, an index out of range, no faces,
        a surface that is not closed, not consistently oriented or encloses no volume, an edge
        length out of range, or if parts or gaps are too thin for the edge length, so that a part
        other than a tip is lost or touches another; use `fill_surface` for such surfaces.

    Notes
    -----
    Isosurface stuffing (Labelle and Shewchuk 2007, see `stuffing.stuff`) of the signed distance. It
    takes seconds where `fill_surface`, which follows the surface within a tolerance, may take
    minutes.
    """
    surface = closed_input(vertices, faces, who="stuff_surface", mend=mend)
    check_share(edge_length, "edge_length", largest=0.5, who="stuff_surface")
    require_function("stuff_surface", "progress", progress)
    distance = SignedDistance(surface.vertices, surface.faces)

    def implicit(points: FloatArray) -> FloatArray:
        check_stop()
        return distance(points)

    low, high = surface.vertices.min(axis=0), surface.vertices.max(axis=0)
    fault, without_tips = "", None
    for scale in _SCALES:
        cell = scale * edge_length
        try:
            mesh = stuff(implicit, low, high, cell, progress=progress)
        except ValueError as error:
            fault = str(error)
            continue
        _, distances = closest_boundary_faces(mesh, surface.vertices, limit=_TIP * cell)
        lost = np.flatnonzero(distances > _LOST * cell)
        if not lost.size:
            return _placed(mesh, surface)
        if np.isfinite(distances).all() and are_tips(lost, surface.faces):
            without_tips = mesh, lost.size
        fault = f"{lost.size} of its vertices are far from the tets, vertex {lost[0]} first"
    if without_tips is None:
        raise ValueError(
            f"stuff_surface: edge_length is {edge_length:g} of the diagonal, too long for thin "
            f"parts or gaps of the surface ({fault}); choose a shorter one, or use fill_surface"
        )
    mesh, count = without_tips
    text = f"the tets leave out thin tips of the surface, {count} of its vertices"
    notify(f"{text}, which follow the tets next to them", MeshNotice, stacklevel=2)
    return _placed(mesh, surface)


def _placed(mesh: TetMesh, surface: ClosedInput) -> TetMesh:
    """Scales tets in a surface of diagonal one back, with a notice if they close gaps."""
    notice_closed_gaps(mesh, surface)
    return TetMesh(mesh.vertices * surface.diagonal + surface.center, mesh.tets)
