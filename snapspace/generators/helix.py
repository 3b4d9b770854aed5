"""The cylinder of `cylinder` bent to a helix: a distant pose for shape interpolation."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from snapspace.arguments import require_count, require_finite, require_positive
from snapspace.generators.cylinder import disc_points, extruded_disc_tets
from snapspace.mesh.tet_mesh import TetMesh


def helix(
    radial: int = 2,
    along: int = 52,
    *,
    length: float = 8.0,
    radius: float = 0.35,
    turns: float = 2.0,
    coil_radius: float = 0.55,
    twist: float = 0.0,
) -> TetMesh:
    """Bends the cylinder with the same `radial`, `along`, `length` and `radius` to a helix.

    The centre line keeps its arc length; cross-sections stay plane, undistorted and normal to it,
    and follow a rotation-minimising frame (Bishop 1975), which for a helix is the Frenet frame
    turned back by torsion times arc length.

    Parameters
    ----------
    radial, along, length, radius
        As in `cylinder`; `length` is the arc length of the centre line.
    turns : float, default 2
        Number of windings around the z axis, positive for a right-handed helix.
    coil_radius : float, default 0.55
        Distance of the centre line from the z axis.
    twist : float, default 0, radians
        Extra rotation of the last cross-section about the centre line; it grows evenly along it.

    Returns
    -------
    TetMesh
        Vertex i and tet i correspond to those of `cylinder`. All volumes are positive.

    Raises
    ------
    ValueError
        If a count or size is out of range, if `length` is too short for the windings, or if the
        solid would overlap itself (on the inside of the bend, or from winding to winding).
    """
    radial = require_count("helix", "radial", radial, at_least=1)
    along = require_count("helix", "along", along, at_least=1)
    length = require_positive("helix", "length", length)
    radius = require_positive("helix", "radius", radius)
    coil_radius = require_positive("helix", "coil_radius", coil_radius)
    turns = require_finite("helix", "turns", turns)
    twist = require_finite("helix", "twist", twist)
    rise = _rise_per_radian(length, radius, turns, coil_radius)

    s = np.linspace(0.0, length, along + 1)
    centre, across, up = _bishop_frame(s, coil_radius, rise, math.copysign(1.0, turns))
    angle = twist * s / length
    cos, sin = np.cos(angle)[:, None], np.sin(angle)[:, None]
    first, second = cos * across + sin * up, cos * up - sin * across
    disc = radius * disc_points(radial)
    vertices = (
        centre[:, None, :]
        + disc[None, :, 0, None] * first[:, None, :]
        + disc[None, :, 1, None] * second[:, None, :]
    )
    return TetMesh(vertices.reshape(-1, 3), extruded_disc_tets(radial, along))


def _rise_per_radian(length: float, radius: float, turns: float, coil_radius: float) -> float:
    """Rise of the centre line along z per radian, from its arc length."""
    if turns == 0.0:
        raise ValueError("helix: turns is 0, but must not be; call cylinder for a straight one")
    per_radian = length / (2.0 * math.pi * abs(turns))
    if coil_radius >= per_radian:
        raise ValueError(
            f"helix: coil_radius is {coil_radius}, but {turns} turns of arc length {length} need"
            f" it below {per_radian:.6g}; raise length or lower turns"
        )
    rise = math.sqrt(per_radian**2 - coil_radius**2)
    bend_radius = per_radian**2 / coil_radius
    if radius >= bend_radius:
        raise ValueError(
            f"helix: radius is {radius}, but the centre line bends with radius {bend_radius:.6g};"
            " lower radius or coil_radius"
        )
    # seen along the line, two windings are the pitch times the line's cosine apart
    gap = 2.0 * math.pi * rise * coil_radius / per_radian
    if abs(turns) > 1.0 and 2.0 * radius >= gap:
        raise ValueError(
            f"helix: radius is {radius}, but the windings are only {gap:.6g} apart;"
            " lower radius, coil_radius or turns"
        )
    return rise


def _bishop_frame(
    s: NDArray[np.float64], coil_radius: float, rise: float, hand: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Centre line and two unit normals, each (len(s), 3), at arc lengths `s`.

    The two normals and the tangent are right-handed, like x, y, z of the cylinder.
    """
    per_radian = math.hypot(coil_radius, rise)
    theta = hand * s / per_radian
    cos, sin, zero = np.cos(theta), np.sin(theta), np.zeros_like(theta)
    centre = np.stack([coil_radius * cos, coil_radius * sin, rise * np.abs(theta)], axis=1)
    tangent = np.stack([-hand * coil_radius * sin, hand * coil_radius * cos, zero + rise], axis=1)
    tangent /= per_radian
    normal = np.stack([-cos, -sin, zero], axis=1)
    binormal = np.cross(tangent, normal)
    torsion = hand * rise / per_radian**2
    back_cos, back_sin = np.cos(torsion * s)[:, None], np.sin(torsion * s)[:, None]
    return (
        centre,
        back_cos * normal - back_sin * binormal,
        back_sin * normal + back_cos * binormal,
    )
