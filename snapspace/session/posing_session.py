"""PosingSession: a reduced model that is posed live (paper, sec. 6.2)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..certificate import PosingProbe, ResidualSample
from ..problem import affine_offset, rigid_offset
from ..reduction import Cubature, PosingModel
from .frame_report import FrameReport
from .given_coordinates import given_coordinates
from .sample_starts import SampleStarts
from .sampled_box import is_inside
from .session import Session

FloatArray = NDArray[np.float64]

#: Times the samples' spacing: beyond this, nothing is known from them.
FARTHEST = 1e3


class PosingSession(Session[PosingModel]):
    """Poses of a reduced model: move handles, read vertices.

    Parameters and errors as for `Session`.

    Notes
    -----
    A drag goes on from the last frame's shape. After a jump, a motion farther than the samples that
    the model was trained with lie apart, a shape interpolated between these is the start if its
    energy is lower: from afar the solve could end in another minimum.

    Examples
    --------
    session = snapspace.load("dragon.snapspace").session()
    session.move("head", euler=(0, 0, 0.5), translation=(0, 0, 1))
    session.vertices
    """

    _maps: FloatArray  # (h, 3, 4), of world positions
    _offsets: FloatArray  # (h, 3, 4), relative to the first handle

    @property
    def vertices(self) -> FloatArray:
        """Vertices of the current shape, (n, 3), in the mesh's length unit.

        They are tau + U q, carried along by the first handle's motion if it has one.
        """
        return super().vertices

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
            For an unknown handle, or values that are not three finite numbers: the message names
            handle and entry, handles and shape stay as they were. They also do if the motion is so
            large that the energy overflows; the report's status is then not_finite.
        """
        return self.move_all({handle: (euler, translation)})

    def move_all(self, motions: Mapping[str, tuple[ArrayLike, ArrayLike]]) -> FrameReport:
        """Puts several handles at rigid motions (euler, translation), and solves once.

        As `move`; handles that are not named stay where they are. If one motion is refused, none is
        made.
        """
        maps = {}
        for handle, (euler, translation) in motions.items():
            center = self._center(handle)
            turn = _finite(euler, (3,), f"move: euler of '{handle}'")
            shift = _finite(translation, (3,), f"move: translation of '{handle}'")
            maps[handle] = _world_map(rigid_offset(turn, shift), center)
        return self._solve_at(*self._moved(maps))

    def move_affine(self, handle: str, matrix: ArrayLike) -> FrameReport:
        """Puts a handle at an affine map (3, 4) of world positions (v, 1), and solves.

        Raises
        ------
        ValueError
            For an unknown handle, a matrix of another shape or not finite, or one that is not a
            rigid motion for the first handle; otherwise as for `move`.
        """
        self._center(handle)
        wanted = _finite(matrix, (3, 4), f"move_affine: the matrix of '{handle}'")
        linear = wanted[:, :3]
        rigid = np.allclose(linear @ linear.T, np.eye(3), atol=1e-9) and np.linalg.det(linear) > 0
        if self.model.problem.handles.index(handle) == 0 and not rigid:
            raise ValueError(
                f"move_affine: '{handle}' is the reference of all others and takes rigid motions "
                "only"
            )
        return self._solve_at(*self._moved({handle: wanted}))

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
        return self._solve_at(np.array(maps), offsets)

    def put(self, motions: Sequence[tuple[ArrayLike, ArrayLike]], q: ArrayLike) -> None:
        """Takes a frame that was solved elsewhere, as in the page; nothing is solved.

        Parameters
        ----------
        motions : for each handle a rotation (3, 3) about its centroid and a translation (3,)
        q : array_like, (dimension,) or fewer
            Coordinates of the shape, or the leading ones, which set `dimension`.

        Raises
        ------
        ValueError
            For another number of motions or coordinates, one that is not finite, or a matrix that
            is no rotation; handles and shape stay as they were.
        """
        handles = self.model.problem.handles
        if len(motions) != len(handles):
            raise ValueError(
                f"put: got {len(motions)} motions, but there are {len(handles)} handles"
            )
        maps = {}
        for handle, (rotation, translation) in zip(handles, motions, strict=True):
            turn = _finite(rotation, (3, 3), f"put: the rotation of '{handle.name}'")
            shift = _finite(translation, (3,), f"put: the translation of '{handle.name}'")
            if not np.allclose(turn @ turn.T, np.eye(3), atol=1e-6) or np.linalg.det(turn) < 0:
                raise ValueError(f"put: the matrix of '{handle.name}' is no rotation")
            offset = np.column_stack([turn - np.eye(3), shift])
            maps[handle.name] = _world_map(offset, self._center(handle.name))
        shape = given_coordinates(q, self.model.dimension)
        self.dimension, self._loop.q = len(shape), shape
        self._set(*self._moved(maps))

    def reset(self) -> None:
        """Back to rest: all handles and the shape."""
        handles = len(self.model.problem.handles)
        self._set(np.tile(np.eye(3, 4), (handles, 1, 1)), np.zeros((handles, 3, 4)))
        self._loop.q = np.zeros(self.dimension)

    @property
    def outside(self) -> tuple[str, ...]:
        """Handles that are outside of the box of motions that the model was sampled in.

        There the reduced solution may be far from the full one. Motions are relative to the first
        handle; an affine map that is not a rigid motion is outside.
        """
        problem = self.model.problem
        moving = zip(
            problem.handles.names[1:], problem.domain.bounds, self._offsets[1:], strict=True
        )
        return tuple(name for name, bounds, offset in moving if not is_inside(bounds, offset))

    def set_parameters(self, parameters: ArrayLike) -> FrameReport:
        """`pose`."""
        return self.pose(parameters)

    def _default_minimizer(self, model: PosingModel) -> str:
        # a Hessian of a cubature costs d / 4 times its gradient
        return "bfgs" if isinstance(model.elastic, Cubature) else "newton"

    def _make_loop(self, *, single: bool) -> core.PosingLoop | core.CubatureLoop:
        elastic, handles = self.model.elastic, self.model.handles
        if isinstance(elastic, Cubature):
            if single:
                raise ValueError(
                    "Session: precision 'single' is for exact quartics; a cubature always keeps "
                    "its rows so"
                )
            rows, weights, material = elastic.rows, elastic.weights, elastic.material
            return core.CubatureLoop(
                rows, weights, material.lam, material.mu, handles.K, handles.L, handles.S
            )
        return core.PosingLoop(elastic.coefficients, handles.K, handles.L, handles.S, single=single)

    def _state(self) -> FloatArray:
        return self._offsets

    def _inputs(self) -> FloatArray:
        return self.model.problem.target_displacements(self._offsets).reshape(-1)

    def _placed(self, vertices: FloatArray) -> FloatArray:
        if np.array_equal(self._maps[0], np.eye(3, 4)):
            return vertices
        placed: FloatArray = vertices @ self._maps[0, :, :3].T + self._maps[0, :, 3]
        return placed

    def _make_probe(self, sample: ResidualSample) -> PosingProbe:
        return PosingProbe(self.model.problem, self.model.subspace, sample)

    def _center(self, handle: str) -> FloatArray:
        center: FloatArray = self.model.problem.centroids[self.model.problem.handles.index(handle)]
        return center

    def _moved(self, moved: Mapping[str, FloatArray]) -> tuple[FloatArray, FloatArray]:
        """All handles' maps with some of them moved, and all offsets relative to the first one."""
        maps = self._maps.copy()
        for handle, world_map in moved.items():
            maps[self.model.problem.handles.index(handle)] = world_map
        back = maps[0, :, :3].T  # inverse rotation of the first handle
        offsets = [np.zeros((3, 4))]
        for target, center in zip(maps[1:], self.model.problem.centroids[1:], strict=True):
            shift = target[:, 3] - maps[0, :, 3]
            relative = np.column_stack([back @ target[:, :3], back @ shift])
            offsets.append(affine_offset(relative, center))
        return maps, np.array(offsets)

    def _solve_at(self, maps: FloatArray, offsets: FloatArray) -> FrameReport:
        """Sets and solves; sets back what was if the energy is beyond all numbers."""
        before = self._maps, self._offsets
        self._set(maps, offsets)
        self._start_from(before[1])
        report = self.solve()
        if report.status == "not_finite":
            self._set(*before)
        return report

    def _start_from(self, before: FloatArray) -> None:
        """After a jump from offsets (h, 3, 4): a shape between the samples, if it is lower."""
        if len(self.model.training_parameters) < 2:
            return
        with np.errstate(over="ignore"):  # motions far outside of any use
            jump = self._starts.distance(self._offsets, before)
        if not self._starts.spacing < jump < FARTHEST * self._starts.spacing:
            return
        candidate = self._starts(self._offsets)[: self.dimension]
        present, _ = self._loop.value_and_gradient(self._loop.q)
        known, _ = self._loop.value_and_gradient(candidate)
        if not present <= known and np.isfinite(known):
            self._loop.q = candidate

    @cached_property
    def _starts(self) -> SampleStarts:
        return SampleStarts(self.model)

    def _set(self, maps: FloatArray, offsets: FloatArray) -> None:
        self._maps, self._offsets = maps, offsets
        self._loop.set_offsets(offsets)


def _world_map(offset: FloatArray, center: FloatArray) -> FloatArray:
    """The (3, 4) map of world positions that an offset [A - I | t] about a center stands for."""
    linear = offset[:, :3] + np.eye(3)
    return np.column_stack([linear, center + offset[:, 3] - linear @ center])


def _finite(values: ArrayLike, shape: tuple[int, ...], name: str) -> FloatArray:
    """The values as an array; ValueError, with the entry, unless they are finite and of a shape."""
    array = np.asarray(values, np.float64)
    if array.shape != shape:
        numbers = "three numbers" if shape == (3,) else f"a {shape} matrix"
        raise ValueError(f"{name} needs {numbers}, got {values!r}".replace("\n", ""))
    bad = np.argwhere(~np.isfinite(array))
    if len(bad):
        place = tuple(int(i) for i in bad[0])
        entry = ", ".join(map(str, place))
        raise ValueError(f"{name} has [{entry}] = {array[place]}, but it must be finite")
    return array
