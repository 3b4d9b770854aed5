"""PosingSession: a reduced model that is posed live (paper, sec. 6.2)."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..problem import affine_offset, rigid_offset
from ..reduction import PosingModel
from .frame_report import FrameReport
from .session import Session

FloatArray = NDArray[np.float64]


class PosingSession(Session[PosingModel]):
    """Poses of a reduced model: move handles, read vertices.

    Parameters and errors as for `Session`.

    Examples
    --------
    session = snapspace.load("dragon.snapspace").session()
    session.move("head", euler=(0, 0, 0.5), translation=(0, 0, 1))
    session.vertices
    """

    _maps: FloatArray  # (h, 3, 4), of world positions

    @property
    def vertices(self) -> FloatArray:
        """Vertices of the current shape, (n, 3), in the mesh's length unit.

        They are tau + U q, carried along by the first handle's motion if it has one.
        """
        shape = super().vertices
        if not np.array_equal(self._maps[0], np.eye(3, 4)):
            shape = shape @ self._maps[0, :, :3].T + self._maps[0, :, 3]
        return shape

    def move(
        self,
        handle: str,
        *,
        euler: ArrayLike = (0.0, 0.0, 0.0),
        translation: ArrayLike = (0.0, 0.0, 0.0),
    ) -> FrameReport:
        """Puts a handle at a rigid motion from rest about its centroid, and solves.

        The motion is absolute: moving twice to the same place is moving once. The first handle,
        which was fixed while sampling, may move as well: the problem is solved relative to it, so
        that the same rigid motion of all handles carries the shape along rigidly.

        Parameters
        ----------
        handle : str
        euler : three angles in radians, extrinsic x, y, z
        translation : three lengths

        Raises
        ------
        ValueError
            For an unknown handle, or values that are not three finite numbers; the shape stays as
            it was.
        """
        return self.move_all({handle: (euler, translation)})

    def move_all(self, motions: Mapping[str, tuple[ArrayLike, ArrayLike]]) -> FrameReport:
        """Puts several handles at rigid motions (euler, translation), and solves once.

        As `move`; handles that are not named stay where they are. If one motion is refused, none is
        made.
        """
        maps = {}
        for handle, (euler, translation) in motions.items():
            offset = rigid_offset(_three(euler, "euler"), _three(translation, "translation"))
            maps[handle] = _world_map(offset, self._center(handle))
        self._place(maps)
        return self.solve()

    def move_affine(self, handle: str, matrix: ArrayLike) -> FrameReport:
        """Puts a handle at an affine map (3, 4) of world positions (v, 1), and solves.

        Raises
        ------
        ValueError
            For an unknown handle, a matrix of another shape or not finite, or one that is not a
            rigid motion for the first handle.
        """
        wanted = np.asarray(matrix, np.float64)
        if wanted.shape != (3, 4) or not np.isfinite(wanted).all():
            raise ValueError(f"move_affine: needs a finite (3, 4) matrix, got shape {wanted.shape}")
        linear = wanted[:, :3]
        rigid = np.allclose(linear @ linear.T, np.eye(3), atol=1e-9) and np.linalg.det(linear) > 0
        if self.model.problem.handles.index(handle) == 0 and not rigid:
            raise ValueError(
                f"move_affine: '{handle}' is the reference of all others and takes rigid motions "
                "only"
            )
        self._place({handle: wanted})
        return self.solve()

    def pose(self, parameters: ArrayLike) -> FrameReport:
        """Puts all handles at a parameter vector (dimension,), and solves.

        Parameters outside of the domain's bounds are allowed.

        Raises
        ------
        ValueError
            For another shape, or a parameter that is not finite.
        """
        offsets = self.model.problem.offsets(parameters)
        centers = self.model.problem.centroids
        maps = [_world_map(offset, center) for offset, center in zip(offsets, centers, strict=True)]
        self._maps = np.array(maps)
        self._loop.set_offsets(offsets)
        return self.solve()

    def reset(self) -> None:
        """Back to rest: all handles and the shape."""
        handles = len(self.model.problem.handles)
        self._maps = np.tile(np.eye(3, 4), (handles, 1, 1))
        self._loop.set_offsets(np.zeros((handles, 3, 4)))
        self._loop.q = np.zeros(self.dimension)

    def set_parameters(self, parameters: ArrayLike) -> FrameReport:
        """`pose`."""
        return self.pose(parameters)

    def _make_loop(self, *, single: bool) -> core.PosingLoop:
        elastic, handles = self.model.elastic, self.model.handles
        return core.PosingLoop(elastic.coefficients, handles.K, handles.L, handles.S, single=single)

    def _center(self, handle: str) -> FloatArray:
        center: FloatArray = self.model.problem.centroids[self.model.problem.handles.index(handle)]
        return center

    def _place(self, maps: Mapping[str, FloatArray]) -> None:
        """Sets handles' maps, and the offsets of all handles relative to the first."""
        for handle, world_map in maps.items():
            self._maps[self.model.problem.handles.index(handle)] = world_map
        back = self._maps[0, :, :3].T  # inverse rotation of the first handle
        offsets = [np.zeros((3, 4))]
        for target, center in zip(self._maps[1:], self.model.problem.centroids[1:], strict=True):
            shift = target[:, 3] - self._maps[0, :, 3]
            relative = np.column_stack([back @ target[:, :3], back @ shift])
            offsets.append(affine_offset(relative, center))
        self._loop.set_offsets(np.array(offsets))


def _world_map(offset: FloatArray, center: FloatArray) -> FloatArray:
    """The (3, 4) map of world positions that an offset [A - I | t] about a center stands for."""
    linear = offset[:, :3] + np.eye(3)
    return np.column_stack([linear, center + offset[:, 3] - linear @ center])


def _three(values: ArrayLike, name: str) -> FloatArray:
    array = np.asarray(values, np.float64)
    if array.shape != (3,) or not np.isfinite(array).all():
        raise ValueError(f"move: {name} needs three finite numbers, got {values!r}")
    return array
