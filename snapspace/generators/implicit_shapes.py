"""Implicit shapes as building blocks: negative inside, near the surface almost a distance.

All functions take points as an array (k, 3) and return values (k,), in the length unit of the
points. They are cheap to evaluate on many points and are combined by `smooth_union`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

FloatArray = NDArray[np.float64]

_SAMPLES = 9
_STEPS = 3
_TINY = 1e-12


def sphere(points: FloatArray, centre: ArrayLike, radius: float) -> FloatArray:
    """Signed distance to a sphere."""
    x, y, z = (points - np.asarray(centre, dtype=np.float64)).T
    return np.asarray(_length(x, y, z) - radius)


def ellipsoid(
    points: FloatArray,
    centre: ArrayLike,
    radii: ArrayLike,
    axes: ArrayLike | None = None,
) -> FloatArray:
    """Estimated distance to an ellipsoid; its zero set is exact.

    The estimate is of first order, (k - 1) / |grad k| with k the distance from the centre in units
    of the radii, or the distance to the ball around the ellipsoid if that is larger.

    Parameters
    ----------
    points : ndarray, (k, 3)
        Where to evaluate.
    centre, radii : array_like, (3,)
        Centre and semi-axes.
    axes : array_like, (3, 3), optional
        Rows are the unit vectors of the three radii. Default: x, y, z.
    """
    local = points - np.asarray(centre, dtype=np.float64)
    if axes is not None:
        local = local @ np.asarray(axes, dtype=np.float64).T
    a, b, c = (float(radius) for radius in np.asarray(radii, dtype=np.float64))
    x, y, z = (np.ascontiguousarray(column) for column in local.T)
    level = _length(x / a, y / b, z / c)
    slope = np.maximum(_length(x / (a * a), y / (b * b), z / (c * c)), _TINY)
    return np.asarray(np.maximum(level * (level - 1.0) / slope, _length(x, y, z) - max(a, b, c)))


def bent_cone(points: FloatArray, control: ArrayLike) -> FloatArray:
    """Signed distance to balls swept along a Bezier curve, smooth where the curve is smooth.

    The nearest ball is the best of `_SAMPLES`, refined by `_STEPS` Newton steps. For a curve
    without sharp bends the value is exact to about 1e-6 of its size near the surface, and to about
    1e-3 far away.

    Parameters
    ----------
    points : ndarray, (k, 3)
        Where to evaluate.
    control : array_like, (c, 4)
        Control points x, y, z, radius; at least 2.
    """
    balls = np.asarray(control, dtype=np.float64)
    velocity = (len(balls) - 1) * np.diff(balls, axis=0)
    bend = (len(velocity) - 1) * np.diff(velocity, axis=0)
    samples = np.linspace(0.0, 1.0, _SAMPLES)
    x, y, z = (np.ascontiguousarray(column) for column in points.T)

    best = np.full(len(points), np.inf)
    t = np.zeros(len(points))
    for sample, ball in zip(samples, _bezier(balls, samples).T, strict=True):
        value = _length(x - ball[0], y - ball[1], z - ball[2]) - ball[3]
        nearer = value < best
        best[nearer] = value[nearer]
        t[nearer] = sample
    low, high = np.maximum(t - samples[1], 0.0), np.minimum(t + samples[1], 1.0)
    for _ in range(_STEPS):
        cx, cy, cz, _ = _bezier(balls, t)
        vx, vy, vz, vr = _bezier(velocity, t)
        ax, ay, az, ar = _bezier(bend, t) if len(bend) else np.zeros((4, 1))
        px, py, pz = x - cx, y - cy, z - cz
        distance = _length(px, py, pz)
        # distance times the derivative of (distance - radius): smooth even if the point is on
        # the curve. Its sign keeps the minimum bracketed when Newton's step leaves the bracket
        along = px * vx + py * vy + pz * vz
        first = -along - distance * vr
        second = vx * vx + vy * vy + vz * vz - px * ax - py * ay - pz * az
        second += along / np.maximum(distance, _TINY) * vr - distance * ar
        low, high = np.where(first < 0.0, t, low), np.where(first < 0.0, high, t)
        step = t - first / np.where(second > 0.0, second, 1.0)
        good = (second > 0.0) & (step >= low) & (step <= high)
        t = np.where(good, step, 0.5 * (low + high))
    cx, cy, cz, cr = _bezier(balls, t)
    return np.asarray(np.minimum(best, _length(x - cx, y - cy, z - cz) - cr))


def smooth_union(first: FloatArray, second: FloatArray, blend: float) -> FloatArray:
    """Union whose crease is filled where the two values differ by less than `blend`.

    The quadratic polynomial minimum: continuously differentiable, at most blend / 4 below the
    plain minimum, and equal to it elsewhere.
    """
    overlap = np.maximum(blend - np.abs(first - second), 0.0)
    return np.asarray(np.minimum(first, second) - overlap * overlap * (0.25 / blend))


def _bezier(control: FloatArray, t: FloatArray) -> FloatArray:
    """Points (d, k) of the Bezier curve with control points (c, d) at parameters (k,)."""
    degree = len(control) - 1
    coefficients = np.zeros_like(control)
    for i in range(degree + 1):
        for j in range(i + 1):
            sign = -1.0 if (i - j) % 2 else 1.0
            coefficients[i] += sign * math.comb(degree, i) * math.comb(i, j) * control[j]
    result = np.empty((control.shape[1], len(t)))
    result[:] = coefficients[degree, :, None]
    for row in coefficients[degree - 1 :: -1] if degree else ():
        result *= t
        result += row[:, None]
    return result


def _length(x: FloatArray, y: FloatArray, z: FloatArray) -> FloatArray:
    return np.asarray(np.sqrt(x * x + y * y + z * z))
