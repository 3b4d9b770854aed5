"""Input that fit_poses refuses, and the messages."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from snapspace import _core as core
from snapspace.fitting import DEVIATION, check_deviation, fit_poses
from snapspace.generators import bar
from snapspace.mesh.embedded_surface import EmbeddedSurface

from .bodies import body

MESH, SURFACE = body()
REST = SURFACE.vertices(MESH.vertices)
COUNT = len(REST)


@pytest.mark.parametrize(
    "targets", [REST, REST[None, :-1], np.zeros((0, COUNT, 3)), np.zeros((2, COUNT, 2))]
)
def test_targets_of_another_surface(targets: np.ndarray) -> None:
    with pytest.raises(ValueError, match=rf"targets have shape .* so \(poses, {COUNT}, 3\)"):
        fit_poses(MESH, SURFACE, targets)


def test_a_target_that_is_not_finite() -> None:
    target = REST.copy()
    target[5, 1] = np.inf
    with pytest.raises(ValueError, match="point 5 of pose sad is not finite"):
        fit_poses(MESH, SURFACE, [REST, target], names=["happy", "sad"])


def test_names_of_other_poses() -> None:
    with pytest.raises(ValueError, match="1 targets have 2 names"):
        fit_poses(MESH, SURFACE, [REST], names=["a", "b"])


def test_a_surface_of_another_mesh() -> None:
    with pytest.raises(ValueError, match="the surface must be embedded in this mesh"):
        fit_poses(bar(2, 1, 1), SURFACE, [REST])


def test_a_surface_without_area() -> None:
    flat = EmbeddedSurface(np.array([[0, 0, 1]], np.int32), SURFACE.corners, SURFACE.weights)
    with pytest.raises(ValueError, match="the surface has no area; check its faces"):
        fit_poses(MESH, flat, [REST])


@pytest.mark.parametrize(
    ("option", "message"),
    [
        ({"deviation": 0.0}, "deviation is 0.0, but it must be positive"),
        ({"deviation": float("nan")}, "deviation is nan, but it must be positive"),
        ({"max_iterations": 0}, "max_iterations is 0, but must be at least 1"),
        ({"threads": 0}, "threads is 0, but must be at least 1"),
    ],
)
def test_options_out_of_range(option: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        fit_poses(MESH, SURFACE, [REST], **option)


@pytest.mark.parametrize("deviation", [0.0, -1.0, float("inf"), float("-inf"), float("nan")])
def test_a_deviation_can_be_checked_before_anything_is_read(deviation: float) -> None:
    with pytest.raises(ValueError, match=f"deviation is {deviation}, but it must be positive"):
        check_deviation(deviation)
    with pytest.raises(ValueError, match=f"deviation is {deviation}, but it must be positive"):
        fit_poses(MESH, SURFACE, [REST], deviation=deviation)


@pytest.mark.parametrize("deviation", [1e-300, DEVIATION, 10.0])
def test_positive_deviations_pass(deviation: float) -> None:
    check_deviation(deviation)


def test_the_core_checks_indices_and_shapes() -> None:
    areas = np.ones(COUNT)
    for corner in (-1, len(MESH.vertices)):
        corners = SURFACE.corners.copy()
        corners[3, 0] = corner
        with pytest.raises(ValueError, match="a surface point has a corner out of range"):
            core.FittingSystem(MESH.vertices, MESH.tets, corners, SURFACE.weights, areas)
    with pytest.raises(ValueError, match="one area per surface point"):
        core.FittingSystem(MESH.vertices, MESH.tets, SURFACE.corners, SURFACE.weights, areas[1:])
    system = core.FittingSystem(MESH.vertices, MESH.tets, SURFACE.corners, SURFACE.weights, areas)
    with pytest.raises(ValueError, match=r"needs a \(3n,\) vector"):
        system.energy(np.zeros(7), stretch=10.0)
    with pytest.raises(ValueError, match=r"targets must be \(points, 3\)"):
        system.fit(
            REST[1:],
            np.zeros(MESH.vertices.size),
            deviation=1e-3,
            first_stiffness=1e-2,
            stretch=10.0,
            max_iterations=5,
            control=core.SolveControl(),
        )
