"""One implicit shape blended from many parts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from snapspace.generators.implicit_shapes import bent_cone, ellipsoid, smooth_union

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Part:
    """An implicit shape, a ball around it, and the width over which it blends with earlier parts.

    Attributes
    ----------
    value : callable, (k, 3) -> (k,)
        Value of the shape, negative inside; at least the distance to the ball.
    centre : ndarray, (3,)
        Centre of the ball.
    reach : float
        Radius of the ball.
    blend : float
        Width of the blend, as in `smooth_union`.
    """

    value: Callable[[FloatArray], FloatArray]
    centre: FloatArray
    reach: float
    blend: float


def limb(control: ArrayLike, *, blend: float) -> Part:
    """A `bent_cone` as a part; control points (c, 4) are x, y, z, radius."""
    balls = np.asarray(control, dtype=np.float64)
    # A Bezier curve stays in the hull of its control points, and so do its balls.
    centre = 0.5 * (balls[:, :3].min(axis=0) + balls[:, :3].max(axis=0))
    reach = float(np.max(np.linalg.norm(balls[:, :3] - centre, axis=1) + balls[:, 3]))
    return Part(lambda points: bent_cone(points, balls), centre, reach, blend)


def lump(
    centre: ArrayLike,
    radii: ArrayLike,
    *,
    blend: float,
    axes: ArrayLike | None = None,
) -> Part:
    """An `ellipsoid` as a part."""
    middle = np.asarray(centre, dtype=np.float64)
    return Part(
        lambda points: ellipsoid(points, middle, radii, axes),
        middle,
        float(np.max(np.asarray(radii, dtype=np.float64))),
        blend,
    )


def blended(points: FloatArray, parts: tuple[Part, ...]) -> FloatArray:
    """Value of the smooth union of parts, in order, at points (k, 3).

    A part is evaluated only where it can have an effect. Elsewhere it is farther away than the
    earlier parts by more than the blend, and the smooth union is the value so far.
    """
    result = np.full(len(points), np.inf)
    for part in parts:
        offset = points - part.centre
        ball = np.sqrt(np.einsum("ij,ij->i", offset, offset)) - part.reach
        near = np.flatnonzero(ball < result + part.blend)
        values = part.value(points[near])
        before = result[near]
        first = np.isinf(before)
        before[first] = values[first] + part.blend
        result[near] = smooth_union(before, values, part.blend)
    return result
