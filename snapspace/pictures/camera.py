"""A perspective camera, placed so that a set of points just fills its frame."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

# Horizontal axes (e1, e2) of each up axis, such that e1 x e2 = up.
_AXES = {"z": (0, 1, 2), "y": (2, 0, 1), "x": (1, 2, 0)}


@dataclass(frozen=True)
class Camera:
    """A pinhole camera; `right`, `up` and `back` are an orthonormal right-handed frame."""

    eye: NDArray[np.float64]  # (3,)
    right: NDArray[np.float64]  # (3,)
    up: NDArray[np.float64]  # (3,)
    back: NDArray[np.float64]  # (3,) from the scene towards the eye
    focal: float  # pixels per unit of length at distance 1
    width: int  # pixels
    height: int  # pixels

    @classmethod
    def framing(
        cls,
        points: NDArray[np.float64],
        *,
        width: int,
        height: int,
        azimuth: float = -60.0,
        elevation: float = 15.0,
        up: str = "z",
        field_of_view: float = 24.0,
        margin: float = 0.08,
    ) -> Camera:
        """The nearest camera of a given direction that sees all the points.

        The points touch the inner frame on both sides horizontally or vertically and are centred
        in the other direction. Closed form: a point stays within a side of the view pyramid if
        the eye stays within a half-space, so the tightest four of them fix the eye.

        Parameters
        ----------
        points : ndarray, (n, 3)
            For a series of pictures at one scale, the points of all of them.
        width, height : int
            Frame in pixels.
        azimuth, elevation : float
            Direction from the scene to the eye, degrees. Azimuth 0 looks from +x and 90 from +y
            when up is "z" (cyclically: from +z and +x for "y", from +y and +z for "x").
        up : {"x", "y", "z"}
        field_of_view : float
            Angle of the shorter side of the frame, degrees, between 0 and 180.
        margin : float
            Empty border as a fraction of the half width and half height.

        Raises
        ------
        ValueError
            If `up` is unknown, an angle is not finite, or the field of view or margin are out of
            range.
        """
        _check_view(azimuth, elevation, up, field_of_view, margin)
        right, lift, back = _frame(azimuth, elevation, up)
        across, along, depth = points @ right, points @ lift, points @ back

        focal = 0.5 * min(width, height) / np.tan(0.5 * np.radians(field_of_view))
        slope_x = (1.0 - margin) * 0.5 * width / focal
        slope_y = (1.0 - margin) * 0.5 * height / focal
        x, distance_x = _tightest(across, depth, slope_x)
        y, distance_y = _tightest(along, depth, slope_y)
        # A single point (or a line along the view) leaves the distance open: stay clear of it.
        distance = max(distance_x, distance_y, float(depth.max()) + 1e-3 * _extent(points))
        return cls(x * right + y * lift + distance * back, right, lift, back, focal, width, height)

    def scaled(self, factor: int) -> Camera:
        """The same view with `factor` times as many pixels in each direction."""
        return replace(
            self,
            focal=self.focal * factor,
            width=self.width * factor,
            height=self.height * factor,
        )

    def extended(self, beside: int, beyond: int) -> Camera:
        """The same view with pixels added on the left and right, and above and below."""
        return replace(self, width=self.width + 2 * beside, height=self.height + 2 * beyond)

    def project(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Screen points (n, 3): x right, y down in pixels, and depth -1 / distance.

        This depth is affine on the screen, so triangles stay flat. Distance is along the view axis.

        Raises
        ------
        ValueError
            If a point is not in front of the eye.
        """
        relative = points - self.eye
        distance = -(relative @ self.back)
        if not np.all(distance > 0.0):
            behind = int(np.flatnonzero(~(distance > 0.0))[0])
            raise ValueError(
                f"Camera: point {behind} at {points[behind]} is behind the eye at {self.eye}; "
                "include it in the points to frame"
            )
        scale = self.focal / distance
        x = 0.5 * self.width + scale * (relative @ self.right)
        y = 0.5 * self.height - scale * (relative @ self.up)
        return np.column_stack([x, y, -1.0 / distance])

    def rays(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        """Directions (k, 3), of length 1 along the view axis, from the eye through (x, y)."""
        across = (x - 0.5 * self.width) / self.focal
        along = (0.5 * self.height - y) / self.focal
        directions: NDArray[np.float64] = (
            across[:, None] * self.right + along[:, None] * self.up - self.back
        )
        return directions


def horizontal_axes(up: str) -> NDArray[np.float64]:
    """Rows e1, e2, up: the right-handed world frame in which azimuth turns from e1 to e2."""
    return np.eye(3)[list(_AXES[up])]


def direction(azimuth: float, elevation: float, up: str) -> NDArray[np.float64]:
    """Unit vector (3,) of an azimuth and elevation in degrees."""
    back: NDArray[np.float64] = _frame(azimuth, elevation, up)[2]
    return back


def _frame(azimuth: float, elevation: float, up: str) -> NDArray[np.float64]:
    """Rows right, up, back of a camera that looks from this azimuth and elevation."""
    turn, rise = np.radians(azimuth), np.radians(elevation)
    local = np.array(
        [
            [-np.sin(turn), np.cos(turn), 0.0],
            [-np.sin(rise) * np.cos(turn), -np.sin(rise) * np.sin(turn), np.cos(rise)],
            [np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)],
        ]
    )
    frame: NDArray[np.float64] = local @ horizontal_axes(up)
    return frame


def _tightest(
    offset: NDArray[np.float64], depth: NDArray[np.float64], slope: float
) -> tuple[float, float]:
    """Eye offset and distance for which +-offset <= slope * (distance - depth) just holds."""
    plus = float((offset + slope * depth).max())
    minus = float((-offset + slope * depth).max())
    return 0.5 * (plus - minus), 0.5 * (plus + minus) / slope


def _extent(points: NDArray[np.float64]) -> float:
    return float(np.linalg.norm(np.ptp(points, axis=0))) or 1.0


def _check_view(
    azimuth: float, elevation: float, up: str, field_of_view: float, margin: float
) -> None:
    if up not in _AXES:
        raise ValueError(f"Camera: up is {up!r}; choose 'x', 'y' or 'z'")
    for name, angle in (("azimuth", azimuth), ("elevation", elevation)):
        if not np.isfinite(angle):
            raise ValueError(f"Camera: {name} is {angle}; give a finite angle in degrees")
    if not 0.0 < field_of_view < 180.0:
        raise ValueError(
            f"Camera: field_of_view is {field_of_view}; give degrees between 0 and 180"
        )
    if not 0.0 <= margin < 1.0:
        raise ValueError(f"Camera: margin is {margin}; give a fraction from 0 up to below 1")
