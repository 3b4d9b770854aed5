"""Closure: what a reduced solve takes from the training samples beside the energy."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..blas import single_threaded_blas
from ..reduction import PosingModel
from .kriging import Kriging
from .motion_space import MotionSpace
from .sample_starts import NEIGHBOURS

FloatArray = NDArray[np.float64]

#: W over the Hessian at rest, and the errors' variance of the samples' coordinates and forces over
#: that of their deviations from a trend. Chosen by leaving out samples of the Dragon and the
#: Elephant (d = 120, 1000 samples): 0.03 to 0.1 are alike, 0.2 is worse.
STIFFNESS, COORDINATES_NUGGET, FORCES_NUGGET = 0.05, 1e-4, 1e-2
#: The rest pose is known exactly.
_EXACT = 1e-10
#: Spacings from the nearest sample up to which all of it holds, and beyond which nothing does.
NEAR, FAR = 2.0, 4.0
#: Samples that are used at most; the time of the first frame grows with their third power.
MOST_SAMPLES = 2000


class Closure:
    """A pull to the coordinates that the samples let expect, and their residual forces.

    A restriction to a subspace is too stiff: at the projection of a full solution the reduced
    energy is not in equilibrium. Its gradient there, the residual force, is interpolated over the
    handles' motions, and so are the coordinates (kriging, for full solutions are not unique); a
    frame is then the minimiser of

        E(q) + 1/2 (q - a)^T W (q - a) - f . (q - a),    W = 0.05 Hessian at rest,

    with the expected coordinates a and force f. The second term is what variational data
    assimilation calls the background (Lorenc 1986, Q. J. R. Meteorol. Soc. 112). The third is a
    closure: without it a solve at a sample would not return the sample. Residual forces say
    something only where samples are near equilibrium: solved to a tolerance of 1e-5.

    Parameters
    ----------
    loop : the compiled live loop
        Its dimension, at most the model's, is that of the closure.
    model : PosingModel
    motions : MotionSpace
        Of the model.

    Raises
    ------
    ValueError
        If the model has too few samples.
    """

    @single_threaded_blas
    def __init__(self, loop: Any, model: PosingModel, motions: MotionSpace) -> None:
        d, count = loop.dimension, min(len(motions.samples), MOST_SAMPLES)
        rest = np.zeros((len(model.problem.handles), 3, 4))
        needed = 2 * (12 * (len(rest) - 1) + 1)
        if count < needed:
            raise ValueError(
                f"Session: a closure needs {needed} samples for {len(rest)} handles, but the model "
                f"has {count}; train it with more, or leave the closure out"
            )
        kriging = Kriging(np.vstack([motions.samples[:count], motions.point(rest)[None]]))
        self._motions, self._kriging = motions, kriging
        self._samples = model.training_coordinates[:, :d]
        loop.pull(np.zeros(d), np.zeros(d), 0.0)
        states = np.vstack([self._samples[:count], np.zeros((1, d))])
        forces = np.zeros_like(states)
        for force, q, w in zip(forces, states, model.training_parameters[:count], strict=False):
            loop.set_offsets(model.problem.offsets(w))
            force[:] = loop.value_and_gradient(q)[1]
        loop.set_offsets(rest)
        self._stiffness: FloatArray = STIFFNESS * loop.hessian(np.zeros(d))
        self._weights = np.hstack(
            [
                kriging.fitted(states, _nugget(count, COORDINATES_NUGGET)),
                kriging.fitted(forces, _nugget(count, FORCES_NUGGET)),
            ]
        )
        self._target, self._force, self._strength = np.zeros(d), np.zeros(d), 0.0
        self._change = np.zeros(d)

    def attach(self, loop: Any) -> None:
        """Gives the loop its W: once, before the first pull after a change of the dimension."""
        loop.set_anchor(self._stiffness)

    def pull(self, loop: Any, offsets: FloatArray) -> None:
        """Sets the loop's anchor for offsets (h, 3, 4); it fades away from all samples."""
        target, strength = self._target, self._strength
        with np.errstate(over="ignore", invalid="ignore"):  # motions far outside of any use
            point = self._motions.point(offsets)
            distances = self._kriging.distances(point)
            self._strength = _faded(float(distances.min()), self._motions.spacing)
            values = self._kriging.row(point, distances) @ self._weights
        if self._strength == 0.0:
            values = np.zeros_like(values)
        self._target, self._force = np.split(values, 2)
        self._change = min(strength, self._strength) * (self._target - target)
        loop.pull(self._target, self._force, self._strength)

    def carry_along(self, loop: Any) -> None:
        """Moves the loop's shape by what the last `pull` changed the expected coordinates by.

        A drag's next frame is nearer to that than to the last one: on the Dragon (d = 120, 60
        frames across the domain) it takes 5.2 evaluations instead of 6.6, and ends in the same
        minima.
        """
        loop.q = loop.q + self._change

    def energy(self, q: FloatArray) -> float:
        """What it adds to the reduced energy at q (d,), for the offsets of the last `pull`."""
        away = q - self._target
        return self._strength * float(away @ (0.5 * self._stiffness @ away - self._force))

    def starts(self, offsets: FloatArray) -> Iterator[tuple[str, FloatArray]]:
        """Names and coordinates (d,) to start from after a jump to the offsets of the last `pull`.

        Those that are expected, or tau where nothing is, and those of the nearest samples.
        """
        yield "sample", self._target
        for k in self._motions.nearest(offsets, NEIGHBOURS):
            yield "sample", self._samples[k]


def _nugget(count: int, nugget: float) -> FloatArray:
    return np.append(np.full(count, nugget), _EXACT)


def _faded(distance: float, spacing: float) -> float:
    """1 up to NEAR spacings, 0 from FAR on and for what is no number, with a continuous slope."""
    if not distance < FAR * spacing:
        return 0.0
    share = min(1.0, (FAR * spacing - distance) / ((FAR - NEAR) * spacing))
    return share * share * (3.0 - 2.0 * share)
