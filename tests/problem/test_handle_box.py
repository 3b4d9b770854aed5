from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from snapspace import HandleBox, sample


def test_parameters_are_translation_then_angles_handle_by_handle() -> None:
    box = HandleBox(translation=(1.0, 2.0, 3.0), angle=0.5, moving=2)
    assert box.dimension == 12
    assert box.half_widths.tolist() == [1, 2, 3, 0.5, 0.5, 0.5] * 2


def test_the_unit_cube_goes_onto_the_box() -> None:
    box = HandleBox(translation=(1.0, 2.0, 3.0), angle=0.5)
    assert HandleBox(translation=(1.0, 2.0, 3.0), angle=0.5, moving=True) == box
    corners = box.from_unit(np.array([np.zeros(6), np.full(6, 0.5), np.ones(6)]))
    assert np.array_equal(corners[0], -box.half_widths)
    assert not corners[1].any()
    assert np.array_equal(corners[2], box.half_widths)


@given(arrays(np.float64, (3, 12), elements=st.floats(0, 1)))
@settings(max_examples=30)
def test_to_unit_is_the_inverse(points: np.ndarray) -> None:
    box = HandleBox(translation=(1e-3, 2.0, 30.0), angle=(0.1, 3.0, np.pi), moving=2)
    parameters = box.from_unit(points)
    assert (np.abs(parameters) <= box.half_widths).all()
    assert box.to_unit(parameters) == pytest.approx(points, abs=1e-15)
    assert box.to_unit(parameters[0]) == pytest.approx(points[0], abs=1e-15)


def test_a_parameter_without_width_stays_in_the_middle() -> None:
    box = HandleBox(translation=(1.0, 0.0, 2.0), angle=0.0)
    points = np.random.default_rng(0).random((4, 6))
    parameters = box.from_unit(points)
    assert not parameters[:, [1, 3, 4, 5]].any()
    back = box.to_unit(parameters)
    assert back[:, [0, 2]] == pytest.approx(points[:, [0, 2]])
    assert (back[:, [1, 3, 4, 5]] == 0.5).all()


def test_scaled_coordinates_are_those_of_the_unit_cube() -> None:
    """A bound's length unit or angle must not weigh in distances between parameters."""
    points = np.random.default_rng(0).random((5, 6))
    for size in (1e-3, 1.0, 1e3):
        box = HandleBox(translation=size, angle=0.1)
        assert box.scaled(box.from_unit(points)) == pytest.approx(points, abs=1e-13)


def test_a_grid_has_at_least_one_point() -> None:
    assert not HandleBox(translation=1.0, angle=0.5).grid(1).any()


OWN = HandleBox(
    translation=[(1.0, 2.0, 3.0), (0.0, 0.0, 0.0), (0.1, 0.1, 0.1)],
    angle=np.array([[0.5, 0.5, 0.5], [0.0, 0.0, 0.0], [0.2, 0.2, 1.0]]),
    moving=3,
)


def test_each_handle_may_have_its_own_bounds() -> None:
    assert OWN.bounds.tolist() == [
        [1, 2, 3, 0.5, 0.5, 0.5],
        [0, 0, 0, 0, 0, 0],
        [0.1, 0.1, 0.1, 0.2, 0.2, 1.0],
    ]
    assert OWN.half_widths.tolist() == OWN.bounds.reshape(-1).tolist()
    same = HandleBox(translation=np.tile([1.0, 2.0, 3.0], (2, 1)), angle=0.5, moving=2)
    common = HandleBox(translation=(1.0, 2.0, 3.0), angle=0.5, moving=2)
    assert same.half_widths.tolist() == common.half_widths.tolist()


def test_a_handle_without_bounds_stays_at_rest_in_samples_and_grids() -> None:
    for parameters in (sample(OWN, 40, method="sobol"), OWN.grid(300)):
        assert (np.abs(parameters) <= OWN.half_widths).all()
        motions = parameters.reshape(len(parameters), 3, 6)
        assert not motions[:, 1].any()
        assert motions[:, [0, 2]].any(axis=(0, 2)).all()
    assert np.ptp(OWN.grid(2**12), axis=0)[OWN.free_axes].all(), "twelve axes are divided once"


def test_boxes_of_the_same_bounds_are_equal_however_they_were_given() -> None:
    again = HandleBox(translation=OWN.bounds[:, :3], angle=OWN.bounds[:, 3:], moving=3)
    assert again == OWN and hash(again) == hash(OWN)
    assert HandleBox(translation=np.array([1.0, 2.0, 3.0]), angle=np.float64(0.5)) == HandleBox(
        translation=(1.0, 2.0, 3.0), angle=0.5
    )


def test_the_common_box_is_the_smallest_that_holds_all_handles() -> None:
    assert OWN.common.bounds.tolist() == [[1, 2, 3, 0.5, 0.5, 1.0]] * 3
    box = HandleBox(translation=1.0, angle=0.5, moving=2)
    assert box.common is box


def test_bounds_follow_the_names_of_handles() -> None:
    box = OWN.renamed(["a", "b", "c"], ["c", "new", "b"])
    assert box.moving == 3
    assert box.bounds.tolist() == [
        OWN.bounds[2].tolist(),
        OWN.common.bounds[0].tolist(),
        [0.0] * 6,
    ]
    common = HandleBox(translation=1.0, angle=0.5)
    assert common.renamed(["a"], ["b", "c"]) == HandleBox(translation=1.0, angle=0.5, moving=2)
    with pytest.raises(ValueError, match="all bounds are zero"):
        OWN.renamed(["a", "b", "c"], ["b"])


def test_angles_of_half_a_turn_are_allowed() -> None:
    assert HandleBox(translation=0.0, angle=np.deg2rad(180)).half_widths[3] == np.pi


BAD: list[tuple[dict[str, Any], str]] = [
    ({"translation": -1.0, "angle": 0.1}, "translation is -1.0, but a bound must be zero or"),
    ({"translation": np.nan, "angle": 0.1}, "translation is nan, but a bound"),
    ({"translation": 1.0, "angle": np.inf}, "angle is inf, but a bound"),
    ({"translation": (1.0, 2.0), "angle": 0.1}, "translation must be one number, three, or"),
    ({"translation": (1.0, -2.0, 1.0), "angle": 0.1}, "translation is (1.0, -2.0, 1.0), but"),
    ({"translation": 1.0, "angle": 45.0}, "angle is 45.0, but it is in radians and at most pi"),
    ({"translation": 1.0, "angle": (0.1, 4.0, 0.1)}, "angle is (0.1, 4.0, 0.1), but it is in"),
    ({"translation": 0.0, "angle": (0.0, 0.0, 0.0)}, "all bounds are zero"),
    ({"translation": 1.0, "angle": 0.1, "moving": 0}, "moving is 0, but at least one handle"),
    ({"translation": np.ones((2, 3)), "angle": 0.1, "moving": 3}, "translation has 2 rows of"),
    ({"translation": 1.0, "angle": np.ones((1, 3)), "moving": 2}, "angle has 1 rows of bounds"),
    ({"translation": np.ones((2, 2)), "angle": 0.1, "moving": 2}, "translation must be one number"),
    ({"translation": [], "angle": 0.1}, "translation must be one number"),
    ({"translation": np.zeros((2, 3)), "angle": 0.0, "moving": 2}, "all bounds are zero"),
]


@pytest.mark.parametrize(("arguments", "message"), BAD)
def test_wrong_bounds_are_refused(arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"HandleBox: {message}")):
        HandleBox(**arguments)


def test_bounds_may_be_whole_numbers_of_any_size() -> None:
    """NumPy keeps whole numbers beyond 64 bits as objects."""
    box = HandleBox(translation=10**30, angle=1)
    assert np.array_equal(box.bounds, [[1e30, 1e30, 1e30, 1, 1, 1]])
