"""The motion that a build suggests is one that its samples contain."""

from __future__ import annotations

import numpy as np
import pytest

from snapspace import HandleBox, Handles, PosingProblem
from snapspace.cli.first_motion import first_motion

from .files import bar_mesh

DEGREES = np.deg2rad(1.0)


def problem(**bounds: object) -> PosingProblem:
    """A bar with two moving handles."""
    mesh = bar_mesh()
    x = mesh.vertices[:, 0]
    handles = Handles([x < 0.1, abs(x - 2) < 0.1, x > 3.9], names=["left", "middle", "right"])
    return PosingProblem(mesh, handles, domain=HandleBox(moving=2, **bounds))


@pytest.mark.parametrize(
    "bounds, options",
    [
        ({"translation": 0.5, "angle": 45 * DEGREES}, ["middle", "--euler", "0,0,20"]),
        ({"translation": 0.5, "angle": 6 * DEGREES}, ["middle", "--euler", "0,0,3"]),
        ({"translation": 0, "angle": (1.0, 1.0, 0.0)}, ["middle", "--euler", "0,20,0"]),
        ({"translation": (0.0, 0.3, 0.1), "angle": 0}, ["middle", "--translate", "0,0.15,0"]),
    ],
)
def test_it_is_within_the_box(bounds: dict[str, object], options: list[str]) -> None:
    assert first_motion(problem(**bounds)) == ["--handle", *options]


def test_it_does_not_move_a_handle_that_the_samples_hold() -> None:
    translation, angle = np.array([[0, 0, 0], [0.2, 0.2, 0.2]]), np.zeros((2, 3))
    held = problem(translation=translation, angle=angle)
    assert first_motion(held) == ["--handle", "right", "--translate", "0.1,0,0"]
    angle[1] = 0.5
    turning = problem(translation=translation, angle=angle)
    assert first_motion(turning)[:3] == ["--handle", "right", "--euler"]


def test_it_does_not_turn_a_handle_of_one_vertex() -> None:
    mesh = bar_mesh()
    handles = Handles([mesh.vertices[:, 0] < 0.1, [len(mesh.vertices) - 1]], names=["left", "tip"])
    pointed = PosingProblem(mesh, handles, domain=HandleBox(translation=0.5, angle=0.5))
    assert first_motion(pointed) == ["--handle", "tip", "--translate", "0.25,0,0"]
