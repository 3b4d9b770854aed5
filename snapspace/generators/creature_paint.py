"""A colour for every vertex of the creature, for pictures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from snapspace.generators.creature_shape import (
    EAR_AXES,
    EAR_CENTRE,
    EYE_CENTRE,
    EYE_RADII,
    HORN,
)
from snapspace.generators.implicit_shapes import bent_cone, ellipsoid, sphere
from snapspace.mesh.tet_mesh import TetMesh

FloatArray = NDArray[np.float64]

_FUR = (0.83, 0.53, 0.33)
_CREAM = (0.97, 0.88, 0.74)
_BLUSH = (0.96, 0.76, 0.66)
_HOOF = (0.36, 0.25, 0.22)
_HORN = (0.94, 0.86, 0.72)
_DARK = (0.13, 0.10, 0.11)
_GLINT = (0.98, 0.98, 0.98)

_NOSE = ((1.325, 0.0, 1.61), 0.095)
_GLINT_BALL = ((1.07, 0.285, 1.785), 0.04)


def creature_paint(mesh: TetMesh) -> FloatArray:
    """Colours of the vertices: russet fur, pale underside, dark eyes, nose and hooves, ivory horns.

    The colours depend on position only; finer meshes have sharper borders.

    Parameters
    ----------
    mesh : TetMesh
        A mesh made by `creature`, at rest; the colours stay with the vertices when it is posed.

    Returns
    -------
    ndarray, (n, 3)
        sRGB, each in [0, 1].
    """
    points = mesh.vertices.copy()
    np.abs(points[:, 1], out=points[:, 1])
    colors = np.broadcast_to(np.array(_FUR), points.shape).copy()
    _mix(colors, _pale(points), _CREAM)
    _mix(colors, _inner_ear(points), _BLUSH)
    _mix(colors, _fade(0.16 - points[:, 2], 0.03), _HOOF)
    _mix(
        colors,
        _fade(0.02 - bent_cone(points, HORN), 0.02) * _fade(points[:, 2] - 1.99, 0.02),
        _HORN,
    )
    _mix(colors, _fade(-sphere(points, *_NOSE), 0.012), _DARK)
    _mix(colors, _fade(0.010 - ellipsoid(points, EYE_CENTRE, EYE_RADII), 0.01), _DARK)
    _mix(colors, _fade(-sphere(points, *_GLINT_BALL), 0.012), _GLINT)
    return colors


def _pale(points: FloatArray) -> FloatArray:
    """Belly, throat, lower jaw and tail tip."""
    x, y, z = points.T
    belly = _fade(0.6 - z + 0.1 * np.cos(6.0 * x), 0.1) * _fade(0.27 - y, 0.08)
    belly *= _fade(0.62 - np.abs(x + 0.05), 0.1)
    throat = _fade(x - 0.42 - 0.45 * (z - 0.9), 0.1) * _fade(0.2 - y, 0.1)
    throat *= _fade(1.5 - z, 0.1) * _fade(z - 0.55, 0.1)
    jaw = _fade(1.6 - 0.25 * (x - 0.9) - z, 0.06) * _fade(x - 0.8, 0.1)
    tip = _fade(z - 1.36, 0.06) * _fade(-1.0 - x, 0.05)
    return np.asarray(1.0 - (1.0 - belly) * (1.0 - throat) * (1.0 - jaw) * (1.0 - tip))


def _inner_ear(points: FloatArray) -> FloatArray:
    ahead, across, along = EAR_AXES @ (points - EAR_CENTRE).T
    hollow = _fade(ahead - 0.01, 0.02) * _fade(0.16 - ahead, 0.02)
    inside = _fade(0.11 - np.abs(across), 0.03) * _fade(0.24 - np.abs(along - 0.03), 0.05)
    return np.asarray(hollow * inside)


def _mix(colors: FloatArray, amount: FloatArray, color: tuple[float, float, float]) -> None:
    colors += amount[:, None] * (np.array(color) - colors)


def _fade(depth: FloatArray, width: float) -> FloatArray:
    """From 0 at depth <= -width to 1 at depth >= width, smoothly."""
    t = np.clip(0.5 + 0.5 * depth / width, 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))
