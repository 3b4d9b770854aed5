"""Shadows of a mesh in light from one direction: a depth map as seen from the light."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .normals import face_normals
from .rasterize import rasterize

Floats = NDArray[np.float32]


class ShadowCaster:
    """A mesh that casts shadows; vertices (n, 3), faces (f, 3) outward."""

    def __init__(self, vertices: NDArray[np.float64], faces: NDArray[np.int32]) -> None:
        self._vertices = vertices
        self._faces = faces
        self._normals = face_normals(vertices, faces)
        self._closed = _is_closed(faces)

    def maps(self, directions: NDArray[np.float64], *, resolution: int) -> list[ShadowMap]:
        """One map for each row of `directions` (k, 3), unit vectors towards the light."""
        return [self._map(towards, resolution) for towards in directions]

    def _map(self, towards: NDArray[np.float64], resolution: int) -> ShadowMap:
        faces = self._faces
        if self._closed:
            # Light enters a closed surface through a face turned to it: no other is ever nearest.
            facing = faces[_along(towards, self._normals.T.astype(np.float32)) > 0.0]
            faces = facing if len(facing) else faces
        return ShadowMap(self._vertices, faces, towards, resolution=resolution)


class ShadowMap:
    """Heights, along a direction, of the first surface that light from there meets.

    Parameters
    ----------
    vertices, faces
        The mesh that casts the shadow: (n, 3) and (f, 3).
    towards_light : ndarray, (3,)
        Unit vector.
    resolution : int
        Texels along the longer side of the mesh as the light sees it.
    """

    def __init__(
        self,
        vertices: NDArray[np.float64],
        faces: NDArray[np.int32],
        towards_light: NDArray[np.float64],
        *,
        resolution: int,
    ) -> None:
        self.light = towards_light
        helper = np.eye(3)[int(np.argmin(np.abs(towards_light)))]
        side = np.cross(towards_light, helper)
        side /= np.linalg.norm(side)
        other = np.cross(towards_light, side)
        plane = np.column_stack([vertices @ side, vertices @ other])
        low, high = plane.min(axis=0), plane.max(axis=0)
        self.texel = float((high - low).max()) / resolution or 1.0
        # A border of two empty texels catches all points beside the mesh.
        size = np.ceil((high - low) / self.texel).astype(int) + 5
        self._rows = np.stack([side, other]) / self.texel
        self._offset = 2.0 - low / self.texel
        screen = np.column_stack([plane / self.texel + self._offset, -(vertices @ towards_light)])
        raster = rasterize(screen, faces, width=int(size[0]), height=int(size[1]))
        self._heights = -raster.depth_image().astype(np.float32)

    def lit(self, position: Floats) -> Floats:
        """Fraction of light, (k,) in 0..1, that arrives at points (3, k).

        Bilinear in the four nearest texels (percentage-closer filtering [Reeves et al. 1987]).
        """
        index, u, v = self._place(position)
        height = _along(self.light, position)
        flat, below = self._heights.ravel(), self._heights.shape[1]
        top = _mix(height >= flat[index], height >= flat[index + 1], u)
        index += below
        bottom = _mix(height >= flat[index], height >= flat[index + 1], u)
        return top + (bottom - top) * v

    def beside(self, position: Floats) -> Floats:
        """Fraction of the line through points (3, k) along the light that misses the mesh.

        For points that have the whole mesh on one side, such as those of the ground.
        """
        index, u, v = self._place(position)
        free, below = np.isneginf(self._heights).ravel(), self._heights.shape[1]
        top = _mix(free[index], free[index + 1], u)
        index += below
        bottom = _mix(free[index], free[index + 1], u)
        return top + (bottom - top) * v

    def _place(self, position: Floats) -> tuple[NDArray[np.int32], Floats, Floats]:
        """Flat index of the upper left of the four texels around points, and fractions."""
        rows, columns = self._heights.shape
        u = _along(self._rows[0], position) + np.float32(self._offset[0] - 0.5)
        v = _along(self._rows[1], position) + np.float32(self._offset[1] - 0.5)
        np.clip(u, 0.0, np.float32(columns - 1.001), out=u)
        np.clip(v, 0.0, np.float32(rows - 1.001), out=v)
        column, row = u.astype(np.int32), v.astype(np.int32)
        return row * columns + column, u - column, v - row


def _is_closed(faces: NDArray[np.int32]) -> bool:
    """Whether every edge is used equally often in both directions."""
    edges = faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2).astype(np.int64)
    count = int(faces.max()) + 1
    forward = np.sort(edges[:, 0] * count + edges[:, 1])
    backward = np.sort(edges[:, 1] * count + edges[:, 0])
    return bool(np.array_equal(forward, backward))


def _along(axis: NDArray[np.float64], position: Floats) -> Floats:
    """Dot products, written out: the result does not depend on a BLAS and its threads."""
    x, y, z = axis.astype(np.float32)
    result: Floats = x * position[0] + y * position[1] + z * position[2]
    return result


def _mix(left: NDArray[np.bool_], right: NDArray[np.bool_], share: Floats) -> Floats:
    result: Floats = left * (1.0 - share) + right * share
    return result
