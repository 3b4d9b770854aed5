"""Filling a closed surface with tets."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import require_function
from ..mesh import TetMesh, repair_tets, tet_volumes
from ..mesh.components import tet_components
from ..point_text import point_text
from .closed_input import check_share, closed_input
from .ftetwild import ftetwild

# Solids with less than this share of the volume are ignored.
_CRUMB = 1e-3


def fill_surface(
    vertices: ArrayLike,
    faces: ArrayLike,
    *,
    edge_length: float = 0.02,
    tolerance: float = 5e-4,
    mend: bool = False,
    progress: Callable[[int], None] | None = None,
) -> TetMesh:
    """Fills a closed triangle surface with tets.

    Parameters
    ----------
    vertices : array_like, (s, 3)
        Points of the surface.
    faces : array_like of int, (f, 3)
        Closed and consistently oriented, outward or inward. Self-intersections are allowed: the
        inside is where the winding number is positive, so overlapping parts become one.
    edge_length : float, default 0.02
        Target edge length of the tets where the surface does not need shorter edges, as a share of
        the diagonal of the surface's bounding box.
    tolerance : float, default 5e-4
        Largest distance of the tets' boundary from the surface, as a share of the diagonal. Thinner
        parts may be lost, and narrower gaps may be closed. Smaller values need more tets and time.
    mend : bool, default False
        Accept any triangles, such as scans with holes and triangle soup. Points are merged, faces
        flipped and flat or small holes closed, see `mend_surface`. Separate parts that stay open
        and have less than half of the area are left out. If more stays open, the inside is where
        the generalised winding number is above one half. A `MeshNotice` says what was done.
    progress : callable, optional
        Called with the number of fTetWild's passes over all tets so far.

    Returns
    -------
    TetMesh
        Its boundary is near the surface but has its own vertices; `embed_surface` embeds the given
        surface in the tets.

    Raises
    ------
    MissingExtraError
        If the extra `snapspace[fill]`, which has fTetWild, is not installed; a ValueError.
    ValueError
        For wrong shapes or types, coordinates that are not finite, an index out of range, no faces,
        a surface that is not closed or not consistently oriented (without `mend`) or encloses no
        volume, options out of range, if the tets form several separate solids, or if fTetWild
        fails.

    Notes
    -----
    Hu, Schneider, Wang, Zorin, Panozzo, "Fast Tetrahedral Meshing in the Wild", 2020 (package
    pytetwild). It takes from seconds to minutes, and can be interrupted with Ctrl-C. It stops
    improving the tets at an AMIPS energy of 30, which suffices for deformations. **Not
    reproducible:** it inserts the points in an order drawn from the system's random numbers and
    offers no seed, so two runs differ in some tets. Write the mesh to a file to keep it.

    See Also
    --------
    stuff_surface : fills surfaces without very thin parts in seconds instead of minutes.
    """
    surface = closed_input(vertices, faces, who="fill_surface", mend=mend, leave_open=True)
    check_share(edge_length, "edge_length", largest=1.0, who="fill_surface")
    require_function("fill_surface", "progress", progress)
    check_share(tolerance, "tolerance", largest=0.1, who="fill_surface")
    tet_vertices, tets = ftetwild(
        surface.vertices,
        surface.faces,
        edge_length=edge_length,
        tolerance=tolerance,
        progress=progress,
    )
    placed = tet_vertices * surface.diagonal + surface.center
    _check_one_solid(placed, tets)
    mesh, _ = repair_tets(placed, tets)
    return mesh


def _check_one_solid(vertices: NDArray[np.float64], tets: NDArray[np.int32]) -> None:
    if not len(tets):
        raise ValueError(
            "fill_surface: fTetWild found nothing inside the surface, which may be thinner than "
            "the tolerance everywhere; lower the tolerance"
        )
    volumes = np.abs(tet_volumes(vertices, tets))
    solid = tet_components(tets, len(vertices))
    share = np.bincount(solid, volumes) / volumes.sum()
    solids = int((share > _CRUMB).sum())
    if solids > 1:
        second = solid == np.argsort(-share)[1]
        middles = vertices[tets[second]].mean(axis=1)
        center = np.average(middles, axis=0, weights=volumes[second])
        around = point_text(center, float(np.linalg.norm(np.ptp(vertices, axis=0))))
        percent = 100 * np.sort(share)[-2]
        raise ValueError(
            f"fill_surface: the tets form {solids} separate solids (the second largest: "
            f"{percent:.2g} % of the volume around {around}), but one is needed; join them "
            "or remove all but one, or lower the tolerance if a thin bridge was lost"
        )
