"""HandleBox: the parameter domain of posing."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..arguments import (
    as_arrays,
    as_numbers,
    is_whole,
    require_count,
    require_type,
    shown,
    wrong_type,
)

FloatArray = NDArray[np.float64]
Vector = tuple[float, float, float]
Bounds = float | Vector | Sequence[Vector] | FloatArray


@dataclass(frozen=True, kw_only=True)
class HandleBox:
    """Translations and Euler angles of the moving handles within given bounds (paper, sec. 4.1).

    Parameters
    ----------
    translation : float, three floats, or three for each moving handle
        Largest offset per axis, in the mesh's length unit.
    angle : float, three floats, or three for each moving handle
        Largest extrinsic Euler angle about x, y, z, in radians.
    moving : int, default 1
        Number of moving handles. `PosingProblem` sets it where bounds are common to all.

    Raises
    ------
    ValueError
        For a bound that is negative or not finite, for bounds that are all zero, an angle beyond
        pi, or bounds for another number of handles.

    Notes
    -----
    A parameter vector has 6 entries per moving handle: translation x, y, z, then angles alpha,
    beta, gamma. The domain is [-bound, bound] along each. A handle whose bounds are all zero is
    held at rest in all samples, as the first one of a problem is.
    """

    translation: Bounds
    angle: Bounds
    moving: int = 1

    def __post_init__(self) -> None:
        for name in ("translation", "angle"):
            bounds = _numbers(getattr(self, name), name)
            if isinstance(getattr(self, name), np.ndarray) or bounds.ndim == 2:
                object.__setattr__(self, name, _as_tuples(bounds))  # for comparisons
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
        if not is_whole(self.moving):
            raise wrong_type("HandleBox", "moving", self.moving, "give a whole number")
        object.__setattr__(self, "moving", int(self.moving))
        if self.moving < 1:
            raise ValueError(
                f"HandleBox: moving is {self.moving}, but at least one handle must move"
            )
        for name in ("translation", "angle"):
            shape = np.shape(getattr(self, name))
            if len(shape) == 2 and shape[0] != self.moving:
                raise ValueError(
                    f"HandleBox: {name} has {shape[0]} rows of bounds, but moving is "
                    f"{self.moving}; give one row per moving handle, or three numbers for all"
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
        return self.bounds.reshape(-1)

    @property
    def bounds(self) -> FloatArray:
        """Bounds handle by handle, (moving, 6): translation x, y, z, angles alpha, beta, gamma."""
        given = (np.asarray(part, np.float64) for part in (self.translation, self.angle))
        return np.concatenate([np.broadcast_to(part, (self.moving, 3)) for part in given], axis=1)

    @property
    def common(self) -> HandleBox:
        """The smallest box with the same bounds for all handles that contains this one."""
        if np.ndim(self.translation) < 2 and np.ndim(self.angle) < 2:
            return self
        largest = self.bounds.max(axis=0)
        return replace(self, translation=largest[:3], angle=largest[3:])

    def renamed(self, old: Sequence[str], new: Sequence[str]) -> HandleBox:
        """The box for other moving handles: bounds belong to names.

        Parameters
        ----------
        old, new : sequence of str
            Names of the moving handles of this box and of the new one. New names get the bounds of
            `common`.

        Raises
        ------
        ValueError
            If all remaining bounds are zero.
        """
        for names, value in (("old", old), ("new", new)):
            cure = "give the names of the moving handles"
            require_type("HandleBox", names, value, Sequence, cure)
        common = self.common
        if common is self:
            return replace(self, moving=len(new))
        known = dict(zip(old, self.bounds, strict=True))
        other = common.bounds[0]
        rows = np.array([known.get(name, other) for name in new])
        return replace(self, moving=len(new), translation=rows[:, :3], angle=rows[:, 3:])

    @property
    def free_axes(self) -> NDArray[np.bool_]:
        """Mask (dimension,) of the parameters whose bound is not zero."""
        free: NDArray[np.bool_] = self.half_widths > 0
        return free

    def from_unit(self, points: FloatArray) -> FloatArray:
        """Maps points of the unit cube, (k, dimension) in [0, 1], onto the box."""
        points = as_arrays("HandleBox", "points", points, self.dimension)
        return (2.0 * points - 1.0) * self.half_widths

    def to_unit(self, parameters: FloatArray) -> FloatArray:
        """Inverse of `from_unit`; a parameter whose bound is zero becomes 0.5."""
        parameters = as_arrays("HandleBox", "parameters", parameters, self.dimension)
        widths = self.half_widths
        scaled = np.divide(
            parameters, widths, out=np.zeros_like(parameters, dtype=np.float64), where=widths > 0
        )
        return (scaled + 1.0) / 2.0

    def grid(self, count: int) -> FloatArray:
        """Centres of equal cells of the box, the last parameter varying fastest: (k, dimension).

        k is the largest product up to `count` (at least 1) of nearly equal numbers of cells per
        free axis; earlier axes get more cells.
        """
        require_count("HandleBox", "count", count)
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
        """Coordinates in which distances are comparable: those of the unit cube."""
        return self.to_unit(parameters)


def _numbers(value: Any, name: str) -> FloatArray:
    """A number, three, or rows of three; ValueError for anything else."""
    try:
        bounds = as_numbers("HandleBox", name, value)
    except ValueError:
        bounds = np.empty(0)
    if bounds.ndim > 2 or bounds.shape[bounds.ndim - 1 :] not in ((), (3,)) or not bounds.size:
        raise ValueError(
            f"HandleBox: {name} must be one number, three, or three for each moving handle, got "
            f"{shown(value)}"
        )
    return bounds


def _as_tuples(bounds: FloatArray) -> Any:
    """The same numbers, as a number or tuples."""
    if bounds.ndim < 2:
        return tuple(bounds.tolist()) if bounds.ndim else float(bounds)
    return tuple(map(tuple, bounds.tolist()))
