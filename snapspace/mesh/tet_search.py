"""Where points lie in a tet mesh: the tet around each point, or the nearest boundary face."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from .. import _core as core
from .arrays import FloatArray, IndexArray
from .box_tree import BoxTree
from .least_of_each import Integers, least_of_each
from .surface import compact_surface
from .tet_mesh import TetMesh

_BLOCK = 4096  # points at a time: their candidates fit into the cache
# Rounding may put a point outside its tet by this share of the diagonal.
_ROUNDING = 1e-12


def barycentric(tets: FloatArray, points: FloatArray) -> FloatArray:
    """Barycentric coordinates of one point for each tet.

    Parameters
    ----------
    tets : ndarray, (k, 4, 3)
        Corners; positive volumes.
    points : ndarray, (k, 3)
        Inside or outside.

    Returns
    -------
    ndarray, (k, 4)
        Rows sum to one; negative beyond the opposite face.
    """
    first, second, third = (tets[:, i] - tets[:, 0] for i in (1, 2, 3))
    offset = points - tets[:, 0]
    normals = (np.cross(second, third), np.cross(third, first), np.cross(first, second))
    volume = np.einsum("ij,ij->i", first, normals[0])
    last = [np.einsum("ij,ij->i", offset, normal) / volume for normal in normals]
    return np.stack([1.0 - last[0] - last[1] - last[2], *last], axis=1)


def containing_tets(mesh: TetMesh, points: FloatArray) -> tuple[Integers, FloatArray]:
    """The tet in which each point lies deepest.

    Parameters
    ----------
    mesh : TetMesh
    points : ndarray, (k, 3)

    Returns
    -------
    tets : ndarray of int, (k,)
        -1 for points outside all tets; the first tet if a point is on a common face.
    weights : ndarray, (k, 4)
        Barycentric coordinates, at least zero up to rounding; nan outside.
    """
    corners = mesh.vertices[mesh.tets]
    tree = BoxTree(corners.min(axis=1), corners.max(axis=1))
    tets, weights = np.full(len(points), -1), np.full((len(points), 4), np.nan)
    slack = _ROUNDING * mesh.diagonal
    for start in range(0, len(points), _BLOCK):
        here = points[start : start + _BLOCK]
        point, tet = tree.within(here, np.full(len(here), slack))
        found = barycentric(corners[tet], here[point])
        depth = found.min(axis=1)
        keep = np.flatnonzero(depth >= -_ROUNDING)
        best = keep[least_of_each(point[keep], -depth[keep], tet[keep])]
        tets[start + point[best]], weights[start + point[best]] = tet[best], found[best]
    return tets, weights


def closest_boundary_faces(
    mesh: TetMesh, points: FloatArray, *, limit: float
) -> tuple[IndexArray, FloatArray]:
    """The boundary face closest to each point.

    Parameters
    ----------
    mesh : TetMesh
    points : ndarray, (k, 3)
    limit : float
        Largest distance of interest, in the mesh's length unit.

    Returns
    -------
    faces : ndarray of int32, (k,)
        Rows of `mesh.surface`; -1 if no face is within the limit; the first face at a common edge.
    distances : ndarray, (k,)
        Distance to the face; inf if there is none.
    """
    surface = core.FaceTree(*compact_surface(mesh.vertices, mesh.surface))
    faces, distances, _ = surface.closest(points, limit)
    return faces, distances


def least_extrapolated(
    mesh: TetMesh, points: FloatArray, faces: IndexArray
) -> tuple[Integers, FloatArray]:
    """The tet around a boundary face that needs the smallest weights for a point.

    Parameters
    ----------
    mesh : TetMesh
    points : ndarray, (k, 3)
        Outside the mesh.
    faces : ndarray of int, (k,)
        Rows of `mesh.surface`, the face closest to each point.

    Returns
    -------
    tets : ndarray of int, (k,)
        Chosen among all that share a vertex with the face, since the tet behind the face may be a
        sliver, whose coordinates explode off its plane, and tets elsewhere may belong to another
        limb.
    weights : ndarray, (k, 4)
        Barycentric coordinates, with the smallest sum of absolute values.
    """
    order = np.argsort(mesh.tets.ravel(), kind="stable")
    begin = np.searchsorted(mesh.tets.ravel()[order], np.arange(len(mesh.vertices) + 1))
    tets, weights = np.full(len(points), -1), np.full((len(points), 4), np.nan)
    for block in _blocks(len(points)):
        vertices = mesh.surface[faces[block]].ravel()
        count = begin[vertices + 1] - begin[vertices]
        point = np.repeat(np.repeat(block, 3), count)
        within = np.arange(len(point)) - np.repeat(np.cumsum(count) - count, count)
        tet = order[np.repeat(begin[vertices], count) + within] // 4
        found = barycentric(mesh.vertices[mesh.tets[tet]], points[point])
        best = least_of_each(point, np.abs(found).sum(axis=1), tet)
        tets[point[best]], weights[point[best]] = tet[best], found[best]
    return tets, weights


def _blocks(count: int) -> Iterator[Integers]:
    for start in range(0, count, _BLOCK):
        yield np.arange(start, min(start + _BLOCK, count))
