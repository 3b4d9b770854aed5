"""graded_tets: tets inside a closed surface, smaller where it is thin."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from ..mesh import TetMesh
from ..mesh.arrays import FloatArray
from ..mesh.morton_order import morton_order
from ..mesh.tet_search import closest_boundary_faces
from ..stuffing import GradedStuffing, Progress
from ..stuffing.manifold import is_closed_manifold
from ..stuffing.separated import separated, touching_vertices
from .closed_gaps import wrong_loops
from .enclosed_solid import EnclosedSolid

#: How often cells may be halved, and how many fillings are tried.
LEVELS, TRIES = 3, 7
#: Points of the surface farther than this from the tets, in edge lengths, are in a lost part.
LOST = 0.4
#: Where a part is lost, cells are halved at points farther than this. With 0.4 four Lions have a
#: quarter fewer tets, but need twice as many samples; with 0.3 for both, some surfaces never end.
NEARLY_LOST = 0.3
#: Largest distance of these points from each other.
SPACING = 0.4
#: Limits on tets, which may also be a multiple of those of the first try, and on places where their
#: boundary touches itself. Surfaces that are thin everywhere exceed the latter.
MOST_TETS, MOST_GROWTH, MOST_TOUCHING = 200_000, 4, 100
#: Smallest share of the tets that is left where they are parted.
KEPT = 0.98


def graded_tets(
    solid: EnclosedSolid,
    cell: float,
    *,
    most_closed: int,
    progress: Progress | None = None,
) -> TetMesh:
    """Fills a solid, with cells halved where larger ones lose a part of it, until none is lost.

    Cells are also halved where the boundary of the tets touches itself. If it has loops that the
    surface does not have, further tries have to reduce their number.

    Parameters
    ----------
    solid : EnclosedSolid
    cell : float
        Edge length of the largest cells.
    most_closed : int
        Largest number of wrong loops of the boundary.
    progress : as for `stuff`

    Returns
    -------
    TetMesh
        Its boundary is a closed manifold, and no vertex of the surface is farther from it than
        `LOST` times `cell`. The same input gives the same tets.

    Raises
    ------
    ValueError
        If that takes more than three halvings, or one of the limits of this module is exceeded.
    """
    low, high = solid.vertices.min(axis=0), solid.vertices.max(axis=0)
    stuffing = GradedStuffing(solid.distance, low, high, cell, levels=LEVELS, progress=progress)
    points = solid.points(SPACING * cell, clear=LOST * cell)
    levels, best, fewest = np.zeros(len(points), np.intp), None, math.inf
    most_tets = MOST_TETS
    for _ in range(TRIES):
        finer = levels > 0
        vertices, tets = stuffing.tets(points[finer], levels[finer])
        distances, touching = np.full(len(points), np.inf), np.zeros((0, 3))
        if len(tets):
            mesh, touching = _apart(TetMesh(vertices, tets))
            if not finer.any():
                most_tets = max(MOST_TETS, MOST_GROWTH * len(tets))
            elif len(tets) > most_tets or len(touching) > MOST_TOUCHING:
                break
            _, distances = closest_boundary_faces(mesh, points, limit=np.inf)
        if (distances <= LOST * cell).all() and is_closed_manifold(mesh.surface):
            loops = wrong_loops(mesh, solid)
            is_better, fewest = loops < fewest, min(loops, fewest)
            best = mesh if is_better else best
            if not loops or not is_better:
                break
        before, levels = levels, _finer(levels, points / cell, distances / cell, touching / cell)
        if (levels == before).all():
            break
    if best is None or fewest > most_closed:
        raise ValueError("also with tets of an eighth of that length")
    return TetMesh(*morton_order(best.vertices, best.tets))


def _apart(mesh: TetMesh) -> tuple[TetMesh, FloatArray]:
    """The tets without touching boundaries, and the places (k, 3) where they touched.

    They are left as they are if parting them would take away a part of the body.
    """
    touching = mesh.vertices[touching_vertices(mesh.tets)]
    if 0 < len(touching) <= MOST_TOUCHING:
        parted = TetMesh(*separated(mesh.vertices, mesh.tets))
        mesh = parted if len(parted.tets) >= KEPT * len(mesh.tets) else mesh
    return mesh, touching


def _finer(
    levels: NDArray[np.intp], points: FloatArray, distances: FloatArray, touching: FloatArray
) -> NDArray[np.intp]:
    """How often to halve the cells at each point next; all lengths are in cells."""
    more = (distances > NEARLY_LOST) & (distances > LOST).any()
    if len(touching):
        near, _ = cKDTree(touching).query(points)
        more |= near < 0.5**levels
    finer: NDArray[np.intp] = np.minimum(levels + more, LEVELS)
    return finer
