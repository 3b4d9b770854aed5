"""Session: a reduced model that is posed live (paper, sec. 6.2)."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core as core
from .problem import affine_offset, rigid_offset
from .reduction import ReducedModel

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class FrameReport:
    """How one frame was solved.

    status : converged, max_iterations, line_search_failed or not_finite
    iterations, evaluations : of BFGS
    value : reduced objective F; gradient_norm : Euclidean norm of its gradient by q
    seconds : of the solve, without the vertices
    """

    status: str
    iterations: int
    evaluations: int
    value: float
    gradient_norm: float
    seconds: float

    @property
    def converged(self) -> bool:
        """Whether all three termination tests were met."""
        return self.status == "converged"


class Session:
    """Poses of a reduced model: move handles, read vertices.

    Each move solves the reduced problem by BFGS from the last frame's shape, with the inverse
    Hessian at rest as the first approximation.

    Parameters
    ----------
    model : ReducedModel
    tolerance : float, default 1e-7
        eps of the termination tests (paper, sec. 6.2), which are relative to a strain of 10 % and
        a displacement of a tenth of the diagonal.
    max_iterations : int, default 300
        Bound on the work of one frame.

    Raises
    ------
    ValueError
        For a tolerance or bound that is not positive.

    Examples
    --------
    session = snapspace.load("dragon.snapspace").session()
    session.move("head", euler=(0, 0, 0.5), translation=(0, 0, 1))
    session.vertices
    """

    def __init__(
        self, model: ReducedModel, *, tolerance: float = 1e-7, max_iterations: int = 300
    ) -> None:
        if not tolerance > 0 or max_iterations < 1:
            raise ValueError(
                f"Session: tolerance {tolerance} and max_iterations {max_iterations} must be "
                "positive"
            )
        self.model = model
        self.tolerance = tolerance
        self.max_iterations = max_iterations
        handles = model.handles
        self._loop = core.PosingLoop(model.elastic.coefficients, handles.K, handles.L, handles.S)
        self._maps: FloatArray
        self.reset()

    @property
    def q(self) -> FloatArray:
        """Reduced coordinates of the current shape, (d,)."""
        q: FloatArray = self._loop.q
        return q

    @property
    def vertices(self) -> FloatArray:
        """Vertices of the current shape, (n, 3), in the mesh's length unit.

        They are tau + U q, carried along by the first handle's motion if it has one.
        """
        shape = self.model.subspace.shape(self.q).reshape(-1, 3)
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
        self._loop.q = np.zeros(self.model.dimension)

    def solve(self) -> FrameReport:
        """Solves for the handles as they are, from the current shape."""
        begin = time.perf_counter()
        report = self._loop.solve(
            tolerance=self.tolerance,
            max_iterations=self.max_iterations,
            value_scale=self.model.value_scale,
            coordinate_scale=self.model.coordinate_scale,
        )
        return FrameReport(
            report.status.name,
            report.iterations,
            report.evaluations,
            report.value,
            report.gradient_norm,
            time.perf_counter() - begin,
        )

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
