"""Layout: where the numbers of a surface file are in its bytes."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from ..arrays import FloatArray
from .slots import Slots

IntArray = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Directions:
    """Normals or tangents of a file.

    slots : places of the j vectors
    of_corner : (c,), the vector of each corner, -1 for none
    kind : normals stay perpendicular to directions that they were perpendicular to; tangents move
        with edges
    """

    slots: Slots
    of_corner: IntArray
    kind: Literal["normal", "tangent"] = "normal"


def _same(data: bytes, points: FloatArray) -> bytes:
    return data


@dataclass(frozen=True, eq=False)
class Layout:
    """Points and polygons of a surface file, and the places of its numbers.

    data : the bytes that slots refer to: the file's own, or the buffers of a glTF file
    points : places of the k points
    corners : (c,), the point of each corner of each polygon, polygon by polygon
    sizes : (p,), number of corners of each polygon
    repeats_points : whether the format has one point per corner, so that equal points are one
        vertex (STL, glTF)
    directions : normals and tangents that the file stores
    to_world : (k, 3, 4), affine maps of the file's points into the common frame; None: none needed
    finish : makes the file from patched bytes and new points (k, 3)
    refers_to : names of other files that this one refers to, such as its materials
    """

    data: bytes
    points: Slots
    corners: IntArray
    sizes: IntArray
    repeats_points: bool = False
    directions: tuple[Directions, ...] = ()
    to_world: FloatArray | None = None
    finish: Callable[[bytes, FloatArray], bytes] = _same
    refers_to: tuple[str, ...] = field(default=())

    def world_points(self) -> FloatArray:
        """The points of the file in the common frame, (k, 3)."""
        local = self.points.values
        if self.to_world is None:
            return local
        turned = np.einsum("kij,kj->ki", self.to_world[:, :, :3], local)
        return np.asarray(turned + self.to_world[:, :, 3])

    def largest_term(self) -> float:
        """The largest of the terms whose sums are the coordinates in the common frame."""
        sizes = np.abs(self.points.values)
        if self.to_world is not None:
            maps = np.abs(self.to_world)
            sizes = np.einsum("kij,kj->ki", maps[:, :, :3], sizes) + maps[:, :, 3]
        return float(sizes.max(initial=0.0))

    def local_points(self, world: FloatArray) -> FloatArray:
        """The inverse of `world_points` for any points (k, 3)."""
        if self.to_world is None:
            return world
        offset = (world - self.to_world[:, :, 3])[:, :, None]
        return np.asarray(np.linalg.solve(self.to_world[:, :, :3], offset)[:, :, 0])
