"""The studio: a soft key from the upper left, a fill, a rim from behind, and the sky."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .camera import direction, horizontal_axes

GOLDEN_ANGLE = np.pi * (3.0 - np.sqrt(5.0))


@dataclass(frozen=True)
class Lamp:
    """A round light at infinity, given as directions of equal strength."""

    center: NDArray[np.float64]  # (3,) unit vector towards the light
    directions: NDArray[np.float64]  # (k, 3) unit vectors spread over its disc
    irradiance: NDArray[np.float64]  # (3,) linear light on a surface that faces the centre


@dataclass(frozen=True)
class Studio:
    """All light of a picture."""

    lamps: tuple[Lamp, ...]
    sphere: NDArray[np.float64]  # (k, 3) unit vectors of equal solid angle
    up: NDArray[np.float64]  # (3,)

    def sky_at(self, height: float) -> NDArray[np.float64]:
        """Radiance (3,) from directions with this sine of the elevation; open ground below 0."""
        return _HORIZON + (_ZENITH - _HORIZON) * height if height >= 0.0 else _GROUND


# Light is in units in which a white matte surface under irradiance 1 has radiance 1.
# Degrees right of the camera, degrees above the horizon, half angle of the disc, number of
# directions, irradiance (linear light).
_LAMPS = (
    (-60.0, 48.0, 8.0, 44, (0.84, 0.805, 0.76)),
    (55.0, 20.0, 22.0, 8, (0.09, 0.094, 0.10)),
    (158.0, 32.0, 14.0, 8, (0.32, 0.33, 0.35)),
)
_ZENITH = np.array((0.42, 0.43, 0.445))
_HORIZON = np.array((0.23, 0.235, 0.24))
_GROUND = np.array((0.34, 0.31, 0.285))
_SPHERE_DIRECTIONS = 96


def studio(azimuth: float, up: str) -> Studio:
    """The light for a camera at `azimuth` degrees, which turns with the camera around `up`."""
    lamps = tuple(
        _lamp(direction(azimuth + turn, rise, up), half, count, np.array(irradiance))
        for turn, rise, half, count, irradiance in _LAMPS
    )
    frame = horizontal_axes(up)
    return Studio(lamps, _sphere(_SPHERE_DIRECTIONS) @ frame, frame[2])


def _lamp(
    center: NDArray[np.float64], half: float, count: int, irradiance: NDArray[np.float64]
) -> Lamp:
    """A sunflower of directions: even over the disc at any count [Vogel 1979]."""
    helper = np.eye(3)[int(np.argmin(np.abs(center)))]
    side = np.cross(center, helper)
    side /= np.linalg.norm(side)
    other = np.cross(center, side)
    order = np.arange(count)
    radius = np.tan(np.radians(half)) * np.sqrt((order + 0.5) / count)
    turn = order * GOLDEN_ANGLE
    spread = center + np.outer(radius * np.cos(turn), side) + np.outer(radius * np.sin(turn), other)
    return Lamp(center, spread / np.linalg.norm(spread, axis=1, keepdims=True), irradiance)


def _sphere(count: int) -> NDArray[np.float64]:
    """A Fibonacci lattice: directions of equal solid angle, the third axis is the pole."""
    order = np.arange(count)
    height = 1.0 - (2.0 * order + 1.0) / count
    radius = np.sqrt(1.0 - height**2)
    turn = order * GOLDEN_ANGLE
    return np.column_stack([radius * np.cos(turn), radius * np.sin(turn), height])
