"""PosingSession: a reduced model that is posed live (paper, sec. 6.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..arguments import require_type
from ..reduction import PosingModel
from ..timeline import Timeline
from .display_shapes import Vertices
from .finite_input import finite
from .frame_report import FrameReport
from .given_coordinates import given_coordinates
from .given_rotation import Turn, given_rotation, is_rotation
from .handle_maps import Motion, given_maps, motions_of, relative_offsets, wanted_maps, world_maps
from .motion_space import MotionSpace
from .posing_loop import posing_loop
from .sample_starts import SampleStarts
from .sampled_box import is_inside
from .session import Session
from .trajectory import between_maps, keyed

FloatArray = NDArray[np.float64]


class PosingSession(Session[PosingModel]):
    """Poses of a reduced model: move handles, read vertices.

    Parameters and errors as for `Session`.

    Notes
    -----
    A drag starts from the last frame's shape. A jump, longer than the spacing of the training
    samples, starts from the last shape or one between them, whichever is lower in energy.
    """

    _maps: FloatArray  # (h, 3, 4), maps of world positions
    _offsets: FloatArray  # (h, 3, 4), relative to the first handle

    @property
    def vertices(self) -> FloatArray:
        """Vertices of the current shape, (n, 3): tau + U q, carried along by the first handle."""
        return super().vertices

    def move(
        self,
        handle: str,
        *,
        euler: ArrayLike | None = None,
        rotation: Turn | None = None,
        translation: ArrayLike = (0.0, 0.0, 0.0),
    ) -> FrameReport:
        """Moves a handle rigidly from rest, about its centroid, and solves.

        The motion is absolute: a second call replaces the first. The first handle may move as well;
        a rigid motion that all handles share carries the whole shape along.

        Parameters
        ----------
        handle : str
        euler : three angles in radians, extrinsic x, y, z, default zero
            More than a full turn gives a warning: these are probably degrees.
        rotation : optional, instead of `euler`
            A matrix (3, 3), a quaternion (x, y, z, w) of any length, or SciPy's `Rotation`.
        translation : three lengths, default zero

        Raises
        ------
        ValueError
            For an unknown handle, `euler` and `rotation` together, a matrix that is not a rotation,
            values that are not finite, or a wrong number of them. The message names the handle and
            the entry, and handles and shape stay as they were. They also stay if the motion is so
            large that the energy overflows; then the report's status is not_finite.
        """
        if rotation is not None and euler is not None:
            raise ValueError(f"move: '{handle}' has both euler and rotation; give one of them")
        require_type("move", "handle", handle, str, "give the name of a handle")
        turn: Turn = (0.0, 0.0, 0.0) if euler is None else euler
        if rotation is not None:
            turn = given_rotation(rotation, f"move: rotation of '{handle}'")
        return self.move_all({handle: (turn, translation)})

    def move_all(self, motions: Mapping[str, Motion]) -> FrameReport:
        """Moves several handles rigidly, and solves once.

        As `move`; handles that are not named stay where they are. If one motion is invalid, no
        handle moves.

        Parameters
        ----------
        motions : mapping from a handle's name to (turn, translation)
            The turn is three Euler angles, or a rotation as for `move`.
        """
        return self._solve_at(*self._moved(self._wanted(motions, who="move")))

    def animate(
        self,
        keys: Sequence[Mapping[str, Motion]] | Timeline,
        *,
        frames: int | None = None,
        easing: str = "smooth",
    ) -> Iterator[FrameReport]:
        """Moves the handles from their current places through keys, frame by frame.

        Between keys, centroids move straight, and each handle turns at a constant rate about one
        axis. `vertices` is each frame's shape; `write_animation` writes files, GIF or MP4.

        Parameters
        ----------
        keys : sequence of mappings as for `move_all`, or a Timeline
            A handle that a key does not name stays where it was at the previous key, or at rest in
            the first key of a timeline.
        frames : int, default 60, and for a timeline 30 a second
            The first has the handles where they are now, and the last is the last key.
        easing : "smooth" or "linear", default "smooth"
            Whether each leg begins and ends slowly. The keys of a timeline have their own easing.

        Yields a FrameReport of each frame, once it is solved.

        Raises
        ------
        ValueError
            As for `move_all`, without keys, for fewer than two frames, an unknown easing or a
            timeline of weights, or if the map of a handle is affine but not rigid.

        Examples
        --------
        >>> shapes = [session.vertices for _ in session.animate(read_timeline("nod.json"))]
        """
        if not all(is_rotation(linear) for linear in self._maps[:, :, :3]):
            raise ValueError("animate: a handle is at a map that is not rigid; call reset() first")
        motions, shares, anew = keyed(keys, frames, easing, "posing")
        centers = self.model.problem.centroids
        states = [np.tile(np.eye(3, 4), (len(centers), 1, 1)) if anew else self._maps]
        for key in motions:
            states.append(self._with(self._wanted(key, who="animate"), states[-1]))
        path = between_maps(np.array(states[anew:]), centers, shares)
        return (self._solve_at(maps, relative_offsets(maps, centers)) for maps in path)

    def move_affine(self, handle: str, matrix: ArrayLike) -> FrameReport:
        """Moves a handle by an affine map (3, 4) of world positions (v, 1), and solves.

        Raises
        ------
        ValueError
            For an unknown handle, a matrix that has another shape or is not finite, or, for the
            first handle, one that is not a rigid motion; otherwise as for `move`.
        """
        self._center(handle)
        wanted = finite(matrix, (3, 4), f"move_affine: the matrix of '{handle}'")
        linear = wanted[:, :3]
        if self.model.problem.handles.index(handle) == 0 and not is_rotation(linear):
            takes = "is the reference of all other handles and takes rigid motions only"
            raise ValueError(f"move_affine: '{handle}' {takes}")
        return self._solve_at(*self._moved({handle: wanted}))

    def pose(self, parameters: ArrayLike) -> FrameReport:
        """Moves all handles to a parameter vector (p,), and solves.

        Parameters outside the domain's bounds are allowed.

        Raises
        ------
        ValueError
            For a wrong shape, or a parameter that is not finite.
        """
        offsets = self.model.problem.offsets(parameters)
        return self._solve_at(world_maps(offsets, self.model.problem.centroids), offsets)

    def put(self, motions: Sequence[tuple[ArrayLike, ArrayLike]], q: ArrayLike) -> None:
        """Adopts a frame that was solved elsewhere, for example in the page; nothing is solved.

        Parameters
        ----------
        motions : for each handle a rotation (3, 3) about its centroid and a translation (3,)
        q : array_like, (dimension,) or fewer
            Coordinates of the shape, or the leading ones. Their number sets `dimension`.

        Raises
        ------
        ValueError
            For a wrong number of motions or coordinates, one that is not finite, or a matrix that
            is not a rotation; handles and shape stay as they were.
        """
        problem = self.model.problem
        maps = given_maps(motions, problem.handles.names, problem.centroids)
        shape = given_coordinates(q, self.model.dimension)
        self.dimension, self._loop.q = len(shape), shape
        self._set(*self._moved(maps))

    @property
    def motions(self) -> dict[str, tuple[FloatArray, FloatArray]]:
        """Each handle's motion from rest, in the form that `move_all` takes.

        A rotation (3, 3), any matrix after `move_affine`, and a translation of the centroid (3,).
        """
        problem = self.model.problem
        return motions_of(self._maps, problem.handles.names, problem.centroids)

    def reset(self) -> None:
        """Returns all handles and the shape to rest."""
        handles = len(self.model.problem.handles)
        self._set(np.tile(np.eye(3, 4), (handles, 1, 1)), np.zeros((handles, 3, 4)))
        self._loop.q = np.zeros(self.dimension)

    @property
    def outside(self) -> tuple[str, ...]:
        """Names of the handles outside the box of motions in which the model was sampled.

        There the reduced solution may be far from the full one. Motions are relative to the first
        handle. Affine maps that are not rigid count as outside.
        """
        domain, names = self.model.problem.domain, self.model.problem.handles.names
        moving = zip(names[1:], domain.bounds, self._offsets[1:], strict=True)
        return tuple(name for name, bounds, offset in moving if not is_inside(bounds, offset))

    def set_parameters(self, parameters: ArrayLike) -> FrameReport:
        """The same as `pose`."""
        return self.pose(parameters)

    def _aim(self, target: Mapping[str, Motion] | None) -> Callable[[], None]:
        before = self._maps, self._offsets
        self._set(*self._moved(self._wanted(target or {}, who="step")))
        return lambda: self._set(*before)

    def _frame(self) -> FloatArray:
        return np.asarray(self._maps[0])

    def _make_loop(self, *, single: bool) -> Any:
        return posing_loop(self.model, single=single)

    def _state(self) -> FloatArray:
        return self._offsets

    def _inputs(self) -> FloatArray:
        return self.model.problem.target_displacements(self._offsets).reshape(-1)

    def _placed(self, vertices: Vertices) -> Vertices:
        if np.array_equal(self._maps[0], np.eye(3, 4)):
            return vertices
        placed = vertices @ self._maps[0, :, :3].T + self._maps[0, :, 3]
        return placed.astype(vertices.dtype, copy=False)

    def _wanted(self, motions: Mapping[str, Motion], *, who: str) -> dict[str, FloatArray]:
        return wanted_maps(motions, self._center, who=who)

    def _center(self, handle: str) -> FloatArray:
        problem = self.model.problem
        return np.asarray(problem.centroids[problem.handles.index(handle)])

    def _moved(self, moved: Mapping[str, FloatArray]) -> tuple[FloatArray, FloatArray]:
        """Maps of all handles with some of them moved, and offsets relative to the first handle."""
        maps = self._with(moved, self._maps)
        return maps, relative_offsets(maps, self.model.problem.centroids)

    def _with(self, moved: Mapping[str, FloatArray], maps: FloatArray) -> FloatArray:
        changed = maps.copy()
        for handle, target in moved.items():
            changed[self.model.problem.handles.index(handle)] = target
        return changed

    def _solve_at(self, maps: FloatArray, offsets: FloatArray) -> FrameReport:
        """Sets the handles and solves; restores the previous state if the energy overflows."""
        before, shape = (self._maps, self._offsets), self.q
        self._set(maps, offsets)
        report = self._solve_from(before[1])
        if report.status == "not_finite":
            self._set(*before)
            self._loop.q = shape
        return report

    def _solve_from(self, before: FloatArray) -> FrameReport:
        """Solves; after a jump from the offsets `before` (h, 3, 4), starts from the samples."""
        if len(self.model.training_parameters) < 2:
            return self.solve()
        if not self._motions.is_jump(self._offsets, before):
            return self.solve()
        return self._lowest_of([self._starts.after_jump(self._offsets, self._loop)])

    def _known_starts(self) -> Iterator[tuple[str, FloatArray]]:
        yield from super()._known_starts()
        if len(self.model.training_parameters) > 1:
            yield self._starts.after_jump(self._offsets, self._loop)

    @cached_property
    def _motions(self) -> MotionSpace:
        return MotionSpace(self.model)

    @cached_property
    def _starts(self) -> SampleStarts:
        return SampleStarts(self._motions, self.model.training_coordinates)

    def _set(self, maps: FloatArray, offsets: FloatArray) -> None:
        self._maps, self._offsets = maps, offsets
        self._loop.set_offsets(offsets)
