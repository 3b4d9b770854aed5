"""Embedding a surface in the tets that fill it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import cKDTree

from ..arguments import is_number, require_type, shown
from .arrays import FloatArray, as_indices, as_points
from .embedded_surface import EmbeddedSurface, single_vertices
from .surface_file import SurfaceFile
from .tet_mesh import TetMesh
from .tet_search import closest_boundary_faces, containing_tets, least_extrapolated
from .validation import check_indices, check_points

#: `farthest` for a surface that the mesh fills: even small parts that filling lost follow the tets.
#: A surface in another unit is still refused.
WHOLE_DIAGONAL = 1.0
_SAME = 1e-9  # points closer than this share of the diagonal coincide


def embed_file(file: SurfaceFile, mesh: TetMesh, *, farthest: float = 0.02) -> EmbeddedSurface:
    """`embed_surface` for a surface file, which becomes the `source` of the embedding."""
    surface = embed_surface(file.vertices, file.faces, mesh, farthest=farthest)
    return replace(surface, source=file)


def embed_surface(
    vertices: ArrayLike, faces: ArrayLike, mesh: TetMesh, *, farthest: float = 0.02
) -> EmbeddedSurface:
    """Embed a surface in the tets around it, so that it follows them.

    Parameters
    ----------
    vertices : array_like, (s, 3)
        The surface at rest, in the unit and frame of the mesh.
    faces : array_like of int, (f, 3)
    mesh : TetMesh
        Its tets fill the surface. A tetrahedraliser may keep the surface only within an envelope.
    farthest : float, default 0.02
        How far outside the tets a vertex may lie, as a share of the mesh's diagonal. Quick tets
        cut off sharp edges within an edge length.

    Returns
    -------
    EmbeddedSurface
        The surface with its own vertices, in their order, and its faces; `vertices(mesh.vertices)`
        are the given vertices up to rounding. If the first s vertices of the mesh are those of the
        surface, the embedding is exact. Otherwise a vertex that coincides with a tet vertex (1e-9
        of the diagonal) follows only that tet vertex, and a vertex inside the mesh has the
        barycentric coordinates of its tet. A vertex outside has the extrapolated coordinates of a
        tet near the closest boundary face: the tet with the smallest weights among all that share a
        vertex with that face.

    Raises
    ------
    ValueError
        For wrong shapes or types, a negative `farthest`, coordinates that are not finite, an index
        out of range, or a vertex that lies farther outside the mesh than is allowed.

    Notes
    -----
    Where parts of the surface overlap or nearly touch, a vertex may be in a tet of the other part.
    """
    cure = "give the TetMesh that fills the surface"
    require_type("embed_surface", "mesh", mesh, TetMesh, cure)
    if not (is_number(farthest) and farthest >= 0):
        raise ValueError(
            f"embed_surface: farthest is {shown(farthest)}, but it must be zero or positive: it is "
            "a share of the mesh's diagonal"
        )
    points = as_points(vertices, who="embed_surface")
    triangles = as_indices(faces, corners=3, who="embed_surface", what="faces")
    check_points(points, who="embed_surface")
    check_indices(triangles, len(points), who="embed_surface", what="face")
    if not len(points):
        raise ValueError("embed_surface: the surface has no vertices; at least one is needed")
    same = _SAME * mesh.diagonal
    count = len(points)
    if count <= len(mesh.vertices) and np.abs(mesh.vertices[:count] - points).max() <= same:
        return single_vertices(triangles, np.arange(count, dtype=np.int32))
    tets, weights = containing_tets(mesh, points)
    _extrapolate_outside(mesh, points, tets, weights, farthest)
    corners = mesh.tets[tets]
    # the nearest tet vertex may belong to a tet that was not chosen, since rounding decides at a
    # vertex
    distance, nearest = cKDTree(mesh.vertices).query(points, distance_upper_bound=same)
    coincides = np.flatnonzero(np.asarray(distance) <= same)
    corners[coincides] = np.asarray(nearest)[coincides, None]
    weights[coincides] = (1.0, 0.0, 0.0, 0.0)
    return EmbeddedSurface(triangles, corners, weights)


def _extrapolate_outside(
    mesh: TetMesh,
    points: FloatArray,
    tets: NDArray[np.intp],
    weights: FloatArray,
    farthest: float,
) -> None:
    """Fill in tets and weights of the points that are outside all tets."""
    outside = np.flatnonzero(tets < 0)
    if not outside.size:
        return
    faces, _ = closest_boundary_faces(mesh, points[outside], limit=farthest * mesh.diagonal)
    far = outside[faces < 0]
    if far.size:
        _, distance = closest_boundary_faces(mesh, points[far[:1]], limit=np.inf)
        raise ValueError(
            f"embed_surface: vertex {far[0]} lies {distance[0]:.4g} outside the tets, "
            f"{distance[0] / mesh.diagonal:.3g} of the mesh's diagonal and more than "
            f"{farthest:g}; {far.size} of {len(points)} vertices affected: give the surface that "
            "the mesh fills, in the same unit and frame, or fill it with "
            "snapspace.fill_surface(vertices, faces)"
        )
    tets[outside], weights[outside] = least_extrapolated(mesh, points[outside], faces)
