from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

from snapspace import in_box, in_sphere

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 1], [2, 2, 2]], dtype=float)


def test_a_box_includes_its_faces() -> None:
    assert in_box(POINTS, [0, 0, 0], [1, 1, 1]).tolist() == [True, True, True, False]


def test_none_leaves_a_side_open() -> None:
    assert in_box(POINTS, [1, None, None], [None, None, 1]).tolist() == [False, True, True, False]
    assert in_box(POINTS, [None] * 3, [None] * 3).all()


def test_a_sphere_includes_its_surface() -> None:
    assert in_sphere(POINTS, [0, 0, 0], 1.0).tolist() == [True, True, False, False]


@pytest.mark.parametrize(
    ("lower", "upper", "message"),
    [
        ([0, 0], [1, 1, 1], "box: a corner needs three numbers (or null), got [0, 0]"),
        ([0, 0, 0], [1, -1, 1], "box: the lower corner [0, 0, 0] must be below the upper corner"),
        ([0, np.nan, 0], [1, 1, 1], "box: the lower corner"),
    ],
)
def test_wrong_boxes_are_refused(lower: Any, upper: Any, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        in_box(POINTS, lower, upper)


@pytest.mark.parametrize(
    ("center", "radius", "message"),
    [
        ([0, 0], 1.0, "sphere: the center needs three finite numbers, got [0, 0]"),
        ([0, np.inf, 0], 1.0, "sphere: the center needs three finite numbers"),
        ([0, 0, 0], 0.0, "sphere: the radius is 0.0, but it must be positive"),
        ([0, 0, 0], np.nan, "sphere: the radius is nan, but it must be positive"),
    ],
)
def test_wrong_spheres_are_refused(center: Any, radius: float, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        in_sphere(POINTS, center, radius)
