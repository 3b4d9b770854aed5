"""HandleBox: the parameter domain of posing."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class HandleBox:
    """Translations and Euler angles of the moving handles up to given bounds (paper, sec. 4.1).

    Parameters
    ----------
    translation : float or three floats
        Largest offset per axis, in the mesh's length unit.
    angle : float or three floats
        Largest extrinsic Euler angle about x, y, z, in radians.
    moving : int, default 1
        Number of moving handles. `PosingProblem` sets it.

    Raises
    ------
    ValueError
        For a bound that is negative or not finite, for bounds that are all zero, or an angle
        beyond pi.

    Notes
    -----
    A parameter vector has 6 entries per moving handle: translation x, y, z, then angles alpha,
    beta, gamma. The domain is [-bound, bound] along each.
    """

    translation: float | tuple[float, float, float]
    angle: float | tuple[float, float, float]
    moving: int = 1

    def __post_init__(self) -> None:
        for name in ("translation", "angle"):
            bounds = np.asarray(getattr(self, name), np.float64)
            if bounds.shape not in ((), (3,)):
                raise ValueError(f"HandleBox: {name} must be one number or three, got {bounds}")
            if not np.isfinite(bounds).all() or (bounds < 0).any():
                raise ValueError(
                    f"HandleBox: {name} is {getattr(self, name)}, but a bound must be zero or "
                    "positive"
                )
        if np.max(self.angle) > np.pi:
            raise ValueError(
                f"HandleBox: angle is {self.angle}, but it is in radians and at most pi; "
                "use numpy.deg2rad for degrees"
            )
        if self.moving < 1:
            raise ValueError(
                f"HandleBox: moving is {self.moving}, but one handle at least must move"
            )
        if not self.half_widths.any():
            raise ValueError("HandleBox: all bounds are zero, so there is nothing to sample")

    @property
    def dimension(self) -> int:
        """Number of parameters, 6 per moving handle."""
        return 6 * self.moving

    @property
    def half_widths(self) -> FloatArray:
        """Bounds of all parameters, (dimension,): the box is [-half_widths, half_widths]."""
        one = np.concatenate([np.broadcast_to(self.translation, 3), np.broadcast_to(self.angle, 3)])
        return np.tile(one.astype(np.float64), self.moving)

    @property
    def free_axes(self) -> NDArray[np.bool_]:
        """Mask (dimension,) of the parameters whose bound is not zero."""
        free: NDArray[np.bool_] = self.half_widths > 0
        return free

    def from_unit(self, points: FloatArray) -> FloatArray:
        """Maps points of the unit cube, (k, dimension) in [0, 1], onto the box."""
        return (2.0 * points - 1.0) * self.half_widths

    def to_unit(self, parameters: FloatArray) -> FloatArray:
        """Inverse of `from_unit`; a parameter without width becomes 0.5."""
        widths = self.half_widths
        scaled = np.divide(
            parameters, widths, out=np.zeros_like(parameters, dtype=np.float64), where=widths > 0
        )
        return (scaled + 1.0) / 2.0

    def grid(self, count: int) -> FloatArray:
        """Centres of equal cells of the box, the last parameter varying fastest: (k, dimension).

        k is the largest product up to `count` (at least 1) of nearly equal numbers per free axis;
        earlier axes are divided first.
        """
        per_axis = [1] * self.dimension
        axes = itertools.cycle(np.flatnonzero(self.free_axes).tolist())
        axis = next(axes)
        while math.prod(per_axis) // per_axis[axis] * (per_axis[axis] + 1) <= count:
            per_axis[axis] += 1
            axis = next(axes)
        centers = [(np.arange(k) + 0.5) / k for k in per_axis]
        points = np.stack(np.meshgrid(*centers, indexing="ij"), axis=-1)
        return self.from_unit(points.reshape(-1, self.dimension))

    def scaled(self, parameters: FloatArray) -> FloatArray:
        """Coordinates in which distances between parameters compare: those of the unit cube."""
        return self.to_unit(parameters)
