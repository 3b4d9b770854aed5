"""`put` takes a frame that was solved elsewhere unchanged."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from snapspace import InterpolationModel, PosingModel
from snapspace.problem import rotation_matrix

REST = (np.eye(3), np.zeros(3))


def test_a_posed_frame_of_another_session_is_shown_and_polished_alike(
    posing_model: PosingModel,
) -> None:
    here, there = posing_model.session(), posing_model.session()
    euler, shift = np.array([0.2, -0.1, 0.4]), np.array([0.1, 0.2, 0.0])
    here.move("foot", euler=(0.0, 0.5, 0.0), translation=(1.0, 0.0, 0.0))
    here.move("head", euler=euler, translation=shift)
    there.put(
        [
            (rotation_matrix([0.0, 0.5, 0.0]), [1.0, 0.0, 0.0]),
            (rotation_matrix(euler), shift),
            REST,
        ],
        here.q,
    )
    np.testing.assert_allclose(there.vertices, here.vertices, atol=1e-12)
    assert there.outside == here.outside
    one, other = here.polish(iterations=3), there.polish(iterations=3)
    np.testing.assert_allclose(one.vertices, other.vertices, atol=1e-9)
    assert other.report.value == pytest.approx(one.report.value)


def test_fewer_coordinates_set_the_dimension(posing_model: PosingModel) -> None:
    here, there = posing_model.session(), posing_model.session()
    here.dimension = 5
    here.move("head", translation=(0.3, 0.0, 0.0))
    there.put([REST, (np.eye(3), [0.3, 0.0, 0.0]), REST], here.q)
    assert there.dimension == 5
    np.testing.assert_array_equal(there.vertices, here.vertices)


def test_a_blend_of_another_session_is_shown(blending_model: InterpolationModel) -> None:
    here, there = blending_model.session(), blending_model.session()
    here.blend([0.2, 0.5, 0.3])
    there.put(here.weights, here.q)
    np.testing.assert_array_equal(there.vertices, here.vertices)
    assert there.weights.tolist() == here.weights.tolist()


@pytest.mark.parametrize(
    ("motions", "q", "message"),
    [
        ([REST] * 2, [0.0], "got 2 motions"),
        ([REST, REST, (2 * np.eye(3), [0, 0, 0])], [0.0], "matrix of 'belly' is not a rotation"),
        ([REST, REST, (-np.eye(3), [0, 0, 0])], [0.0], "matrix of 'belly' is not a rotation"),
        ([REST, (np.eye(3), [0, np.nan, 0]), REST], [0.0], r"'head' has \[1\] = nan"),
        ([REST, (np.eye(2), [0, 0, 0]), REST], [0.0], r"'head' needs a \(3, 3\) matrix"),
        ([REST] * 3, [], r"q has shape \(0,\), but the model has 20"),
        ([REST] * 3, np.zeros(21), r"q has shape \(21,\), but the model has 20"),
        ([REST] * 3, [0.0, np.inf], r"q\[1\] is inf"),
    ],
)
def test_bad_frames_are_refused_and_change_nothing(
    posing_model: PosingModel, motions: Any, q: Any, message: str
) -> None:
    session = posing_model.session()
    session.move("head", translation=(0.3, 0.0, 0.0))
    before = session.vertices
    with pytest.raises(ValueError, match=message):
        session.put(motions, q)
    np.testing.assert_array_equal(session.vertices, before)
