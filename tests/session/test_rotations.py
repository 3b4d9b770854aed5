"""Rotations in all usual forms give a handle the same motion."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from snapspace import PosingModel, PosingSession

EULER = (0.3, -0.2, 0.5)
TURN = Rotation.from_euler("xyz", EULER)


@pytest.fixture
def session(posing_model: PosingModel) -> PosingSession:
    return posing_model.session()


@pytest.mark.parametrize(
    "rotation",
    [TURN, TURN.as_matrix(), TURN.as_quat(), -3.0 * TURN.as_quat(), TURN.as_matrix().tolist()],
    ids=["scipy", "matrix", "quaternion", "long quaternion", "list"],
)
def test_a_rotation_is_the_same_motion_as_its_angles(session: PosingSession, rotation: Any) -> None:
    by_angles = session.move("head", euler=EULER, translation=(0, 0, 0.1))
    expected = session.vertices
    session.reset()
    by_rotation = session.move("head", rotation=rotation, translation=(0, 0, 0.1))
    np.testing.assert_allclose(session.vertices, expected, atol=1e-7)
    assert by_rotation.value == pytest.approx(by_angles.value, rel=1e-9)
    session.reset()
    session.move_all({"head": (rotation, (0, 0, 0.1))})
    np.testing.assert_allclose(session.vertices, expected, atol=1e-7)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"euler": EULER, "rotation": TURN}, "'head' has both euler and rotation"),
        (
            {"rotation": 2 * np.eye(3)},
            "move: rotation of 'head' is a matrix that is not",
        ),
        ({"rotation": np.diag([1.0, 1.0, -1.0])}, "not a rotation"),
        ({"rotation": np.zeros(4)}, "the zero quaternion"),
        ({"rotation": [np.nan, 0, 0, 1]}, r"\[0\] = nan, but it must be finite"),
        ({"rotation": Rotation.from_rotvec([[0.1, 0, 0], [0, 0.2, 0]])}, "'head' is 2 rotations"),
        ({"rotation": np.eye(2)}, r"rotation of 'head' needs a \(3, 3\) matrix, a quaternion \(x"),
        ({"rotation": (0, 0, 0.3)}, r"rotation of 'head' needs a \(3, 3\) matrix, a quaternion"),
        ({"rotation": [[1, 0], [0]]}, "rotation of 'head' needs a"),
    ],
)
def test_rotations_that_are_not_proper_are_refused(
    session: PosingSession, options: dict[str, Any], message: str
) -> None:
    session.move("head", euler=EULER)
    before = session.vertices
    with pytest.raises(ValueError, match=message):
        session.move("head", **options)
    np.testing.assert_array_equal(session.vertices, before)


def test_a_wrong_turn_of_several_handles_is_called_what_it_is(session: PosingSession) -> None:
    for turn, name in ((2 * np.eye(3), "rotation"), (np.zeros(4), "rotation"), ((0, 1), "euler")):
        with pytest.raises(ValueError, match=f"move: {name} of 'head'"):
            session.move_all({"head": (turn, (0, 0, 0))})
