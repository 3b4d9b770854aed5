"""BlendingSession: a reduced interpolation model that is blended live (paper, sec. 6.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .. import _core as core
from ..reduction import BlendedStars, FullBlends, InterpolationModel, PoseQuartics
from ..timeline import Timeline
from .display_shapes import Vertices
from .frame_report import FrameReport
from .full_loop import FullBlendingLoop
from .given_coordinates import given_coordinates
from .posing_loop import SINGLE_CUBATURE
from .sample_values import SampleValues
from .session import Session
from .trajectory import between_rows, keyed

FloatArray = NDArray[np.float64]

#: Solutions farther from the mean shape than this many tenths of the diagonal (root mean square
#: over the shape) are discarded: with negative weights the energy has fallen without bound.
FARTHEST = 100.0


class BlendingSession(Session[InterpolationModel]):
    """Shapes between the poses of a reduced model: set weights, read vertices.

    Parameters and errors are as for `Session`. The default tolerance is 1e-9, because without
    handles the soft modes determine the error.

    Notes
    -----
    A jump goes to weights that are nearer to a training sample than to the last frame. It starts
    from that sample or from the last frame, whichever has the lower energy: from far away a descent
    could end in another minimum. A drag starts from the last frame or, along a straight line, from
    the shape that its last three frames predict. If a frame ends with a higher energy than the
    nearest sample, it is solved again from that sample.

    Examples
    --------
    session = snapspace.load("lion.snapspace").session()
    session.blend([0.3, 0.7])
    session.vertices
    """

    default_tolerance = 1e-9
    _weights: FloatArray
    _sample_values: SampleValues | None = None

    @property
    def weights(self) -> FloatArray:
        """Weights of the current shape, (poses,)."""
        return self._weights.copy()

    def blend(self, weights: ArrayLike, *, extrapolate: bool = False) -> FrameReport:
        """Sets the weights of the poses, and solves.

        Parameters
        ----------
        weights : array_like, (poses,)
            Not negative, with sum one. One-hot weights give the pose as closely as the subspace can
            represent it.
        extrapolate : bool, default False
            Also accepts weights beyond the sampled simplex; their sum must still be one. There the
            energy may have no minimum: then the report's status is unbounded, and shape and weights
            stay as they were. `certain` and `reach` say where a minimum is guaranteed.

        Raises
        ------
        ValueError
            For a wrong number of weights, one that is not finite, a sum that is not one, or a
            weight beyond the sampled simplex without `extrapolate`; the shape stays as it was.
        """
        w = self.model.problem.weights(weights, extrapolate=extrapolate)
        before, shape = self._weights, self.q
        self._set_weights(w)
        report = self._solve_from(before)
        if np.linalg.norm(self.q) > FARTHEST * self.model.coordinate_scale:
            report = replace(report, status="unbounded")
        if report.status in ("unbounded", "not_finite"):
            self._set_weights(before)
            self._loop.q = shape
        return report

    def animate(
        self,
        keys: Sequence[ArrayLike] | Timeline,
        *,
        frames: int | None = None,
        easing: str = "smooth",
    ) -> Iterator[FrameReport]:
        """Blends from the current weights through keys, frame by frame.

        `vertices` is the shape of each frame; `write_animation` writes them as files, GIF or MP4.

        Parameters
        ----------
        keys : sequence of weights (poses,), as for `blend`, or a Timeline
            A timeline begins with its first key.
        frames : int, default 60, and for a timeline 30 a second
            Number of frames. The first has the current weights, the last is the last key.
        easing : "smooth" or "linear", default "smooth"
            Whether each leg begins and ends slowly. The keys of a timeline have their own easing.

        Yields
        ------
        FrameReport
            The report of each frame, once it is solved.

        Raises
        ------
        ValueError
            As for `blend`, and without keys, for fewer than two frames, an unknown easing, a
            timeline of motions or an unknown pose; the shape stays as it was.
        """
        problem = self.model.problem
        given, shares, anew = keyed(keys, frames, easing, "interpolation")
        if anew:
            rows = [_named(weights, problem.poses.names) for weights in given]
            states = np.array([problem.weights(row, extrapolate=True) for row in rows])
        else:
            states = np.array([self._weights, *(problem.weights(key) for key in given)])
        path = between_rows(states, shares)
        return (self.blend(w, extrapolate=True) for w in path)

    def put(self, weights: ArrayLike, q: ArrayLike) -> None:
        """Adopts a frame that was solved elsewhere, for example in the page; nothing is solved.

        Parameters
        ----------
        weights : array_like, (poses,), with sum one
        q : array_like, (dimension,) or fewer
            Coordinates of the shape, or the leading ones. Their number sets `dimension`.

        Raises
        ------
        ValueError
            For a wrong number of weights or coordinates, one that is not finite, or a sum that is
            not one.
        """
        w = self.model.problem.weights(weights, extrapolate=True)
        shape = given_coordinates(q, self.model.dimension)
        self.dimension, self._loop.q = len(shape), shape
        self._set_weights(w)

    def reset(self) -> None:
        """Returns to the mean shape: equal weights."""
        self._set_weights(self.model.problem.domain.center)
        self._loop.q = np.zeros(self.dimension)

    @property
    def outside(self) -> tuple[str, ...]:
        """Poses whose weights are below the lowest weight of the sampled domain."""
        lowest = self.model.problem.domain.lowest - 1e-9
        names = self.model.problem.poses.names
        return tuple(n for n, w in zip(names, self._weights, strict=True) if w < lowest)

    @property
    def certain(self) -> bool | None:
        """Whether the energy certainly has a minimum for the current weights.

        False does not mean that there is none: see `CertainRange`, and the last report's status.
        None where no test is known and a weight is negative.
        """
        certain = self.model.certain_range
        if certain is not None:
            return certain.holds(self._weights)
        return True if (self._weights >= 0.0).all() else None

    def reach(self, toward: ArrayLike) -> float | None:
        """How far a minimum is certain on the line from the current weights toward others.

        Parameters
        ----------
        toward : array_like, (poses,), with sum one

        Returns
        -------
        float or None
            As `CertainRange.reach`: 1.3 means that the line may be extended by three tenths of its
            length. None where no test is known.

        Raises
        ------
        ValueError
            For a wrong number of weights, one that is not finite, or a sum that is not one.
        """
        w = self.model.problem.weights(toward, extrapolate=True)
        certain = self.model.certain_range
        return None if certain is None else certain.reach(w, start=self._weights)

    def set_parameters(self, parameters: ArrayLike) -> FrameReport:
        """`blend` with any weights that sum to one."""
        return self.blend(parameters, extrapolate=True)

    def _set_weights(self, weights: FloatArray) -> None:
        self._weights = weights
        self._loop.set_weights(weights)

    def _solve_from(self, before: FloatArray) -> FrameReport:
        """Solves from the last frame, with the weights `before`, or from the nearest sample."""
        if not len(self.model.training_parameters):
            return self.solve()
        with np.errstate(over="ignore"):  # weights far beyond any use
            away = ((self.model.training_parameters - self._weights) ** 2).sum(axis=1)
            moved = ((before - self._weights) ** 2).sum()
        nearest = int(np.argmin(away))
        candidate = self.model.training_coordinates[nearest, : self.dimension]
        seconds = 0.0
        if away[nearest] < moved:
            current, _ = self._loop.value_and_gradient(self._loop.q)
            if current <= self._loop.value_and_gradient(candidate)[0]:
                return self.solve()
        else:
            report = self.solve()
            margin = self.tolerance * (self.model.value_scale + abs(report.value))
            if report.value - margin <= self._values_of_samples()(nearest, self._weights):
                return report
            seconds = report.seconds
        self._loop.q = candidate
        report = self.solve()
        return replace(report, seconds=seconds + report.seconds, start="sample")

    def _values_of_samples(self) -> SampleValues:
        values = self._sample_values
        if values is None or values.dimension != self.dimension:
            coordinates = self.model.training_coordinates[:, : self.dimension]
            values = SampleValues(self._loop, coordinates, len(self._weights))
            self._sample_values = values
        return values

    def _state(self) -> FloatArray:
        return self._weights

    def _inputs(self) -> FloatArray:
        return self._weights

    def _placed(self, vertices: Vertices) -> Vertices:
        return vertices

    def _aim(self, target: ArrayLike | None) -> Callable[[], None]:
        before = self._weights
        if target is not None:
            self._set_weights(self.model.problem.weights(target))
        return lambda: self._set_weights(before)

    def _frame(self) -> FloatArray:
        return np.eye(3, 4)

    def _make_loop(self, *, single: bool) -> Any:
        blends = self.model.blends
        if isinstance(blends, FullBlends):
            return FullBlendingLoop(self.model, single=single)
        if isinstance(blends, PoseQuartics):
            return core.BlendingLoop(blends.dimension, blends.coefficients, single=single)
        if single:
            raise ValueError(SINGLE_CUBATURE)
        if isinstance(blends, BlendedStars):
            return core.BlendedStarsLoop(*blends.core_arguments)
        return core.BlendedCubatureLoop(*blends.core_arguments)


def _named(weights: Mapping[str, float], names: Sequence[str]) -> FloatArray:
    """Weights (poses,) by the names of some poses; the others are zero."""
    row = np.zeros(len(names))
    for name, weight in weights.items():
        if name not in names:
            raise ValueError(f"animate: unknown pose '{name}'; known are {', '.join(names)}")
        row[list(names).index(name)] = weight
    return row
