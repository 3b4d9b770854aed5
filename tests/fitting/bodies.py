"""Bars and their surfaces, bent by known maps."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from snapspace import TetMesh
from snapspace import _core as core
from snapspace.generators import bar
from snapspace.mesh.embedded_surface import EmbeddedSurface, boundary_surface

FloatArray = NDArray[np.float64]


def body() -> tuple[TetMesh, EmbeddedSurface]:
    """A bar of length 4, and its boundary as a surface."""
    mesh = bar(12, 3, 3)
    return mesh, boundary_surface(mesh)


def bent(points: FloatArray, angle: float) -> FloatArray:
    """Points of the bar after its axis is bent to an arc of `angle` radians about y."""
    radius = 4.0 / angle
    turn = points[:, 0] / radius
    reach = radius - (points[:, 2] - 0.5)
    return np.stack(
        [reach * np.sin(turn), points[:, 1], radius + 0.5 - reach * np.cos(turn)], axis=1
    )


def fitting_system(mesh: TetMesh, surface: EmbeddedSurface) -> core.FittingSystem:
    areas = np.ones(len(surface.corners))
    return core.FittingSystem(mesh.vertices, mesh.tets, surface.corners, surface.weights, areas)


def inverted_tets(mesh: TetMesh, shape: FloatArray) -> int:
    corners = shape[mesh.tets]
    return int((np.linalg.det(corners[:, 1:] - corners[:, :1]) <= 0).sum())


def rms(mesh: TetMesh, difference: FloatArray) -> float:
    """Root mean square length of the rows, relative to the diagonal."""
    return float(np.sqrt((difference**2).sum(axis=1).mean())) / mesh.diagonal
