"""TimeSteps: sessions that step in time."""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from ..arguments import is_finite, shown
from ..reduction import InterpolationModel, PosingModel
from ..subspace import RigidFrames
from .dynamics import Dynamics
from .frame_report import FrameReport

FloatArray = NDArray[np.float64]
Model = TypeVar("Model", bound=PosingModel | InterpolationModel)


@dataclass(frozen=True)
class Movement:
    """Two shapes with a time between them.

    q, before : (d,) coordinates now, and at the start of the last step
    frame, frame_before : (3, 4) maps from the subspace to the world at these times
    dt : seconds between them
    """

    q: FloatArray
    before: FloatArray
    frame: FloatArray
    frame_before: FloatArray
    dt: float

    @property
    def velocity(self) -> FloatArray:
        """(d,), per second."""
        return np.asarray((self.q - self.before) / self.dt)


class TimeSteps(ABC, Generic[Model]):
    """Steps in time by implicit Euler in reduced coordinates, for sessions to inherit from.

    The basis is M-orthonormal, so that a step minimises F(q) + density / (2 dt^2) |q - target|^2,
    where `target` has the coordinates that the body would reach without forces (Martin et al. 2011,
    Example-based elastic materials, sec. 4). It is stable for every dt. While the handles rest, a
    step never increases the mechanical energy: if a nonlinear energy would let it grow, the new
    velocity is reduced.
    """

    model: Model
    _loop: Any
    _dynamics = Dynamics()
    _movement: Movement | None = None
    _known_softest = (0, 0.0)  # dimension, value

    @property
    def dynamics(self) -> Dynamics:
        """Settings of `step`: frequency, damping and gravity."""
        return self._dynamics

    @dynamics.setter
    def dynamics(self, dynamics: Dynamics) -> None:
        if not isinstance(dynamics, Dynamics):
            raise ValueError(f"Session: dynamics must be a Dynamics, not {type(dynamics).__name__}")
        self._dynamics = dynamics

    @property
    def velocity(self) -> FloatArray:
        """Velocity of the coordinates, (dimension,), per second.

        Zero unless the last frame was a step in time.
        """
        return self._moving().velocity

    @property
    def density(self) -> float:
        """Mass per volume that gives the softest vibration the frequency of `dynamics`.

        In units of the material's moduli, lengths and seconds.
        """
        return float(self._softest / (2.0 * np.pi * self._dynamics.frequency) ** 2)

    @property
    def mechanical_energy(self) -> float:
        """Reduced objective with the energies of motion and gravity.

        It never grows in steps in which handles and weights stay.
        """
        value, _ = self._loop.value_and_gradient(self._loop.q)
        return float(value) + self._kinetic(self._moving()) - self._fall(self._loop.q)

    def step(self, dt: float, target: Any = None) -> FrameReport:
        """Advances time by dt: the body swings after its handles, or after its weights.

        Parameters
        ----------
        dt : float
            Seconds, such as 1 / 60. Longer steps damp more.
        target : optional
            Where the handles or weights go during the step, as for `move_all` or `blend`. Default:
            they stay.

        Returns
        -------
        FrameReport
            Its value is the reduced objective at the new shape.

        Raises
        ------
        ValueError
            For a dt that is not positive and finite, as for `move_all` or `blend`, or if the model
            has the energy of all tets, which has no steps in time. The shape stays as it was. It
            also stays if the energy overflows; then the report's status is not_finite.

        Notes
        -----
        After any frame that was not a step, such as one of `move` or `reset`, the body is at rest.
        The first handle's motion counts as well: a body that is carried along lags behind.

        Examples
        --------
        >>> session.move("head", translation=(0, 0, 0.3))
        >>> session.step(1 / 60, {"head": ((0, 0, 0), (0, 0, 0))})  # lets it go
        >>> for _ in range(120):
        ...     session.step(1 / 60)
        """
        if not (is_finite(dt) and dt > 0.0):
            raise ValueError(f"step: dt {shown(dt)} must be positive and finite, in seconds")
        if not hasattr(self._loop, "step"):
            raise ValueError(
                "step: the model has the energy of all tets; reduce with energy='cubature' or "
                "'exact' for steps in time"
            )
        last = self._moving()
        undo = self._aim(target)
        report = self._advance(last, float(dt))
        if report.status == "not_finite":
            undo()
            self._loop.q = last.q
        return report

    @abstractmethod
    def _aim(self, target: Any) -> Callable[[], None]:
        """Sets handles or weights (None keeps them); returns a function that restores them."""

    @abstractmethod
    def _frame(self) -> FloatArray:
        """The map (3, 4) from the subspace to the world."""

    @abstractmethod
    def _solver_options(self) -> dict[str, Any]:
        """Keywords of the loop's `solve` and `step`."""

    @cached_property
    def _frames(self) -> RigidFrames:
        return RigidFrames(self.model.subspace)

    @property
    def _softest(self) -> float:
        """The smallest curvature in the present dimension."""
        dimension: int = self._loop.dimension
        if self._known_softest[0] != dimension:
            self._known_softest = dimension, float(self._loop.softest())
        return self._known_softest[1]

    def _moving(self) -> Movement:
        """The movement up to now; without velocity if the shape is not that of the last step."""
        q, frame, last = self._loop.q, self._frame(), self._movement
        if last and np.array_equal(last.q, q) and np.array_equal(last.frame, frame):
            return last
        return Movement(q, q, frame, frame, 1.0)

    def _advance(self, last: Movement, dt: float) -> FrameReport:
        """Steps from `last` to the present handles or weights; stays if that is not finite."""
        begin = time.perf_counter()
        frame = self._frame()
        report, before = self._loop.step(
            self._target(last, frame, dt), weight=self.density / dt**2, **self._solver_options()
        )
        q = self._loop.q
        if report.status.name != "not_finite":
            self._movement = Movement(q, last.q, frame, last.frame, dt)
            self._limit(last, before, report.value)
        return FrameReport.of(report, time.perf_counter() - begin)

    def _target(self, last: Movement, frame: FloatArray, dt: float) -> FloatArray:
        """Where the body would be after dt without elastic forces, seen from the new frame."""
        kept = np.exp(-4.0 * np.pi * self._dynamics.damping * self._dynamics.frequency * dt)
        now = self._seen(last.q, last.frame, frame)
        before = self._seen(last.before, last.frame_before, frame)
        coasting = kept * dt / last.dt * (now - before)
        return np.asarray(now + coasting + dt**2 * self._weight(len(now)))

    def _seen(self, q: FloatArray, old: FloatArray, new: FloatArray) -> FloatArray:
        """Coordinates of a shape of the frame `old`, projected to the subspace in `new`."""
        if np.array_equal(old, new):
            return q
        back = new[:, :3].T
        return self._frames.coordinates(back @ old[:, :3], back @ (old[:, 3] - new[:, 3]), q)

    def _weight(self, dimension: int) -> FloatArray:
        """Acceleration of the coordinates by gravity, (d,)."""
        gravity = np.array(self._dynamics.gravity, np.float64)
        if not gravity.any():
            return np.zeros(dimension)
        return np.asarray((self._frame()[:, :3].T @ gravity) @ self._frames.ones[:, :dimension])

    def _fall(self, q: FloatArray) -> float:
        return self.density * float(self._weight(len(q)) @ q)

    def _kinetic(self, movement: Movement) -> float:
        return 0.5 * self.density * float(movement.velocity @ movement.velocity)

    def _limit(self, last: Movement, before: float, after: float) -> None:
        """Reduces the velocity if the mechanical energy would grow."""
        new = self._movement
        assert new is not None
        frames = (last.frame_before, last.frame, new.frame)
        if not all(np.array_equal(frame, new.frame) for frame in frames):
            return  # the moving frame does work
        left = before - after + self._kinetic(last) + self._fall(new.q) - self._fall(last.q)
        kinetic = self._kinetic(new)
        if kinetic > max(left, 0.0):
            share = np.sqrt(max(left, 0.0) / kinetic)
            slower = new.q - share * (new.q - new.before)
            self._movement = Movement(new.q, slower, new.frame, new.frame_before, new.dt)
