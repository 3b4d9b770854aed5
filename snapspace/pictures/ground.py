"""The ground: an infinite plane that only shows the shadow on it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from .camera import Camera, horizontal_axes

Floats = NDArray[np.float32]

# Paper transmits some light and its surroundings reflect more, so shadows are lighter than direct
# light alone would make them.
SHADOW_STRENGTH = 0.86


@dataclass(frozen=True)
class Ground:
    """A square of the plane `up . x = level` with its brightness relative to open ground."""

    axes: NDArray[np.float64]  # (3, 3) rows e1, e2, up
    level: float
    corner: NDArray[np.float64]  # (2,) lower corner of the square, along e1 and e2
    spacing: float  # between the nodes of its grid
    brightness: Floats  # (nodes, nodes) 1 is open ground, 1 at the border

    @property
    def nodes(self) -> int:
        """Nodes of the grid on a side."""
        return len(self.brightness)

    @classmethod
    def below(cls, vertices: NDArray[np.float64], *, up: str, level: float, nodes: int) -> Ground:
        """Unshadowed ground that reaches beyond all relevant shadows of the mesh."""
        axes = horizontal_axes(up)
        footprint = vertices @ axes[:2].T
        low, high = footprint.min(axis=0), footprint.max(axis=0)
        height = max(float((vertices @ axes[2]).max()) - level, 0.0)
        side = float((high - low).max()) + 3.2 * height + 1e-6
        corner = 0.5 * (low + high - side)
        return cls(axes, level, corner, side / (nodes - 1), np.ones((nodes, nodes), np.float32))

    def node_positions(self) -> Floats:
        """Positions (3, nodes**2) of the nodes, the second axis running fastest."""
        ticks = np.arange(self.nodes) * self.spacing
        first, second = np.meshgrid(self.corner[0] + ticks, self.corner[1] + ticks, indexing="ij")
        local = np.stack([first.ravel(), second.ravel(), np.full(first.size, self.level)])
        positions: Floats = (self.axes.T @ local).astype(np.float32)
        return positions

    def lit_by(self, light: Floats) -> Ground:
        """This ground with direct light (nodes**2,), where 1 is open; the border stays open."""
        ramp = np.minimum(np.arange(self.nodes), np.arange(self.nodes)[::-1]) / (0.3 * self.nodes)
        ramp = np.clip(ramp, 0.0, 1.0)
        ramp = ramp * ramp * (3.0 - 2.0 * ramp)
        window = SHADOW_STRENGTH * np.minimum(ramp[:, None], ramp[None, :])
        image = 1.0 - window * (1.0 - light.reshape(self.nodes, self.nodes))
        return replace(self, brightness=image.astype(np.float32))

    def brightness_towards(self, position: Floats, towards: NDArray[np.float64]) -> Floats:
        """Relative brightness (k,) of the ground as seen downwards from points (3, k)."""
        x, y, z = self.axes[2].astype(np.float32)
        reach = x * position[0] + y * position[1] + z * position[2] - np.float32(self.level)
        np.clip(reach, 0.0, None, out=reach)
        reach /= np.float32(-(towards @ self.axes[2]))
        hit = position + towards.astype(np.float32)[:, None] * reach
        i = (self._grid_coordinate(0, hit) + np.float32(0.5)).astype(np.int32)
        j = (self._grid_coordinate(1, hit) + np.float32(0.5)).astype(np.int32)
        result: Floats = self.brightness.ravel()[i * self.nodes + j]
        return result

    def in_picture(self, camera: Camera) -> NDArray[np.float64]:
        """Relative brightness (h, w) of the ground behind each pixel; 1 where there is none."""
        image = np.ones(camera.height * camera.width)
        above = float(camera.eye @ self.axes[2]) - self.level
        if above > 0.0:
            row, column = np.divmod(np.arange(len(image)), camera.width)
            rays = camera.rays(column + 0.5, row + 0.5)
            fall = -(rays @ self.axes[2])
            hit = np.flatnonzero(fall > 1e-9)
            position = camera.eye + rays[hit] * (above / fall[hit])[:, None]
            image[hit] = self._at(np.ascontiguousarray(position.T, dtype=np.float32))
        return image.reshape(camera.height, camera.width)

    def _at(self, position: Floats) -> Floats:
        """Relative brightness (k,), bilinear, at points (3, k) of the ground."""
        u = self._grid_coordinate(0, position)
        v = self._grid_coordinate(1, position)
        i, j = u.astype(np.int32), v.astype(np.int32)
        u -= i
        v -= j
        flat, index = self.brightness.ravel(), i * self.nodes + j
        near = flat[index] * (1.0 - v) + flat[index + 1] * v
        far = flat[index + self.nodes] * (1.0 - v) + flat[index + self.nodes + 1] * v
        result: Floats = near * (1.0 - u) + far * u
        return result

    def _grid_coordinate(self, axis: int, position: Floats) -> Floats:
        x, y, z = (self.axes[axis] / self.spacing).astype(np.float32)
        along = x * position[0] + y * position[1] + z * position[2]
        along -= np.float32(self.corner[axis] / self.spacing)
        result: Floats = np.clip(along, 0.0, np.float32(self.nodes - 1.001))
        return result


def smoothed(light: Floats, *, passes: int) -> Floats:
    """Light (k**2,) of a square grid, blurred by sqrt(passes / 2) nodes; uniform light stays so."""
    side = math.isqrt(len(light))
    image = light.reshape(side, side)
    for _ in range(passes):
        for axis in (0, 1):
            image = _binomial(image, axis)
    return image.ravel()


def _binomial(image: Floats, axis: int) -> Floats:
    """One pass of the kernel (1, 2, 1) / 4; the border repeats."""
    padded = np.pad(image, [(1, 1) if i == axis else (0, 0) for i in (0, 1)], mode="edge")
    before, after = (padded[:-2], padded[2:]) if axis == 0 else (padded[:, :-2], padded[:, 2:])
    result: Floats = np.float32(0.25) * (before + after) + np.float32(0.5) * image
    return result
