from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from snapspace.registration import UNITS_DIFFER_BEYOND, matched_scales, scale_factors

from ..shapes import deformed, irregular_bar, moved, random_rotation

BAR = irregular_bar()
BENT = deformed(BAR, 0.02).reshape(-1, 3)
TURNED = moved(BENT.reshape(-1), random_rotation(), 30.0).reshape(-1, 3)


@given(scale=st.floats(1e-6, 1e6))
@settings(max_examples=30)
def test_the_unit_of_length_is_recovered(scale: float) -> None:
    shapes = np.stack([BAR.vertices, scale * BAR.vertices])
    for cells in (BAR.tets, BAR.surface):
        assert scale_factors(shapes, cells) == pytest.approx([1.0, 1.0 / scale], rel=1e-12)


def test_rigid_motions_do_not_matter() -> None:
    shapes = np.stack([BAR.vertices, BENT, TURNED])
    factors = scale_factors(shapes, BAR.tets)
    assert factors[0] == 1.0
    assert factors[2] == pytest.approx(factors[1], rel=1e-12)


def test_a_part_that_grows_does_not_matter() -> None:
    """The factor is a median; a mean would be half as large again."""
    grown = BAR.vertices.copy()
    end = grown[:, 0] > grown[:, 0].max() - 0.1
    grown[end] *= 3.0
    factors = scale_factors(np.stack([BAR.vertices, 10.0 * grown]), BAR.tets)
    assert factors[1] == pytest.approx(0.1)


def test_every_edge_counts_once() -> None:
    """Otherwise inner edges, which many tets share, would outvote the others."""
    shapes = np.random.default_rng(1).random((2, 4, 3))
    edges = np.array([[0, 1], [0, 2], [1, 3], [2, 3], [1, 2]])
    lengths = np.linalg.norm(shapes[:, edges[:, 0]] - shapes[:, edges[:, 1]], axis=2)
    ratios = lengths[1] / lengths[0]
    factor = scale_factors(shapes, [[0, 1, 2], [1, 3, 2]])[1]
    assert factor == pytest.approx(1 / np.median(ratios))
    assert factor != pytest.approx(1 / np.median([*ratios, ratios[4]]))


def test_edges_without_length_in_the_first_pose_are_left_out() -> None:
    vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 0, 0.0]])
    other = np.array([[0, 0, 0], [4, 0, 0], [0, 0, 1.0]])
    factors = scale_factors(np.stack([vertices, other]), [[0, 1, 2]])
    assert factors[1] == pytest.approx(1 / np.mean([4, np.sqrt(17)]))


def test_the_policies() -> None:
    shapes = np.stack([BAR.vertices, 1.2 * BAR.vertices, 0.01 * BAR.vertices])
    for policy, expected in (
        ("keep", [1.0, 1.0, 1.0]),
        ("auto", [1.0, 1.0, 100.0]),
        ("match", [1.0, 1 / 1.2, 100.0]),
    ):
        scaled, factors = matched_scales(shapes, BAR.tets, policy=policy)
        assert factors == pytest.approx(np.array(expected))
        assert scaled == pytest.approx(shapes * np.array(expected)[:, None, None])
        # shapes that are kept are kept to the bit
        assert np.array_equal(scaled[factors == 1.0], shapes[factors == 1.0])


@pytest.mark.parametrize("direction", [1, -1])
def test_the_limit_between_size_and_unit(direction: int) -> None:
    for ratio, changed in (
        (UNITS_DIFFER_BEYOND * 0.999, False),
        (UNITS_DIFFER_BEYOND * 1.001, True),
    ):
        shapes = np.stack([BAR.vertices, ratio**direction * BAR.vertices])
        scaled, factors = matched_scales(shapes, BAR.surface)
        assert (factors[1] != 1.0) == changed
        assert np.allclose(scaled[1], BAR.vertices) == changed


def test_the_given_poses_are_not_changed() -> None:
    shapes = np.stack([BAR.vertices, BAR.vertices])
    for policy in ("keep", "auto", "match"):
        scaled, _ = matched_scales(shapes, BAR.tets, policy=policy)
        assert not np.shares_memory(scaled, shapes)


def with_nan() -> np.ndarray:
    shapes = np.stack([BAR.vertices, BENT])
    shapes[1, 12, 2] = np.nan
    return shapes


BOTH = np.stack([BAR.vertices, BENT])
BAD: list[tuple[Any, Any, str]] = [
    (BAR.vertices, BAR.tets, "shapes must be (k, n, 3), got (36, 3)"),
    (BOTH[:0], BAR.tets, "shapes must be (k, n, 3), got (0, 36, 3)"),
    (with_nan(), BAR.tets, "vertex 12 of pose 1 is not finite"),
    (BOTH, BAR.tets[:, :2], "cells must be faces (f, 3) or tets (m, 4) of integers, got int32 of"),
    (BOTH, BAR.tets * 1.0, "cells must be faces (f, 3) or tets (m, 4) of integers, got float64"),
    (BOTH, [[0, 1, 2], [0, 1, 36]], "cell 1 (0, 1, 36) has an index out of range; the shapes have"),
    (BOTH, [[0, 1, 2], [0, -1, 2]], "cell 1 (0, -1, 2) has an index out of range"),
    (BOTH * [[[0.0]], [[1.0]]], BAR.tets, "all edges of pose 0 have length zero; check its vert"),
    (BOTH, BAR.tets[:0], "all edges of pose 0 have length zero"),
    (BOTH * [[[1.0]], [[0.0]]], BAR.tets, "half of the edges of pose 1 have length zero, so its"),
]


@pytest.mark.parametrize(("shapes", "cells", "message"), BAD)
def test_bad_input_is_refused(shapes: Any, cells: Any, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"scale_factors: {message}")) as caught:
        scale_factors(shapes, cells)
    assert "\n" not in str(caught.value)
    with pytest.raises(ValueError, match=re.escape(f"scale_factors: {message}")):
        matched_scales(shapes, cells)


def test_an_unknown_policy_is_refused() -> None:
    with pytest.raises(ValueError, match="matched_scales: unknown policy 'fit'; known are auto, m"):
        matched_scales(BOTH, BAR.tets, policy="fit")  # type: ignore[arg-type]
