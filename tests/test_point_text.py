"""Corners of boxes far from the origin differ."""

from __future__ import annotations

from snapspace.point_text import corner_texts, point_text


def test_corners_have_four_digits_and_more_far_from_the_origin() -> None:
    assert corner_texts([-1.23456, 0, 2], [1, 2, 3]) == ("(-1.235, 0, 2)", "(1, 2, 3)")
    low, high = corner_texts([199_998.83, 1e5, 0], [200_001.17, 1e5 + 1, 1])
    assert low == "(199998.83, 100000, 0)" and high == "(200001.17, 100001, 1)"


def test_a_point_has_four_digits() -> None:
    assert corner_texts([12345.6] * 3, [12345.6] * 3)[0] == "(1.235e+04, 1.235e+04, 1.235e+04)"
    assert point_text([-1.23456, 0, 2], 3.0) == "(-1.235, 0, 2)"
    assert point_text([199_998.83, 1e5, 0], 3.0) == "(199998.83, 100000, 0)"


def test_rounding_errors_of_zero_are_zero() -> None:
    assert point_text([0.5, -1.3e-19, 0.04], 1.2) == "(0.5, 0, 0.04)"
    assert point_text([3e-12, -2e-12, 0], 5e-12) == "(3e-12, -2e-12, 0)", "a small body"
