"""PoseShapes: the base of poses of tets and of shells, with its checks."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import require_type
from ..counted import counted
from .names import check_names

FloatArray = NDArray[np.float64]


def check_meshes(meshes: object, kind: type, *, who: str) -> None:
    """ValueError unless it is a list of meshes of this kind."""
    cure = f"give a list of {kind.__name__}"
    require_type(who, "meshes", meshes, Sequence, cure)
    assert isinstance(meshes, Sequence)
    for place, mesh in enumerate(meshes):
        require_type(who, f"mesh {place}", mesh, kind, cure)


class PoseShapes:
    """Two or more named shapes (k, n, 3) of one mesh; ValueError, in the name of `who`, otherwise.

    Arguments are as for `Poses`; the shapes are copied and read-only.
    """

    def __init__(self, shapes: ArrayLike, names: Sequence[str] | None, *, who: str) -> None:
        self._shapes = as_shapes(shapes, who=who)
        self._names = as_names(names, len(self._shapes), who=who)
        check_finite_shapes(self._shapes, self._names, who=who)
        self._shapes.setflags(write=False)

    @property
    def shapes(self) -> FloatArray:
        """Vertices of each pose, (k, n, 3) float64."""
        return self._shapes

    @property
    def names(self) -> tuple[str, ...]:
        """Names in order."""
        return self._names

    def __len__(self) -> int:
        return len(self._shapes)


def check_pose_count(count: int, *, who: str) -> None:
    """ValueError for fewer than two poses."""
    if count < 2:
        raise ValueError(f"{who}: got {counted(count, 'pose')}, but at least two are needed")


def as_shapes(shapes: ArrayLike, *, who: str) -> FloatArray:
    """A new (k, n, 3) float64 array of two or more shapes; ValueError for any other input."""
    try:
        array = np.asarray(shapes)
    except ValueError:
        raise ValueError(
            f"{who}: shapes must be one array (k, n, 3); the poses have different vertex counts"
        ) from None
    if array.ndim != 3 or array.shape[2] != 3 or array.dtype.kind not in "fiu":
        raise ValueError(
            f"{who}: shapes must be real numbers (k, n, 3), got {array.dtype} of shape "
            f"{array.shape}"
        )
    check_pose_count(len(array), who=who)
    return np.array(array, dtype=np.float64, order="C")


def as_names(names: Sequence[str] | None, count: int, *, who: str) -> tuple[str, ...]:
    """The names, or pose 0, pose 1, ...; ValueError unless there is a unique one per pose."""
    if names is None:
        return tuple(f"pose {i}" for i in range(count))
    check_names(names, count, who=who, what=counted(count, "pose"))
    return tuple(names)


def check_finite_shapes(shapes: FloatArray, names: tuple[str, ...], *, who: str) -> None:
    """ValueError, which names the first vertex of (k, n, 3) that is not finite."""
    bad = np.argwhere(~np.isfinite(shapes).all(axis=2))
    if len(bad):
        pose, vertex = bad[0]
        x, y, z = shapes[pose, vertex]
        raise ValueError(
            f"{who}: {names[pose]}: vertex {vertex} is not finite ({x:g}, {y:g}, {z:g}); correct "
            "the coordinates at their source"
        )
