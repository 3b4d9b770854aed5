"""Variants of a problem with other boxes and clamps."""

from __future__ import annotations

import numpy as np

from paper.cases import read
from paper.elephant import variant
from paper.elephant_orderings import boxes_in_order


def test_variants_have_a_smaller_box_and_half_of_the_clamp() -> None:
    given = read("elephant", "stvk", quick=True).problem
    small = variant(given, clamp="whole", share=0.5)
    np.testing.assert_allclose(small.domain.bounds, 0.5 * given.domain.bounds)
    assert small.handles == given.handles
    half = variant(given, clamp="half", share=1.0)
    fixed, before = next(iter(half.handles)).vertices, next(iter(given.handles)).vertices
    assert set(fixed) < set(before) and 0.4 < len(fixed) / len(before) < 0.6
    moving = given.centroids[1]
    away = np.linalg.norm(given.mesh.vertices - moving, axis=1)
    assert away[fixed].min() >= np.median(away[before])


def test_a_larger_box_must_be_harder() -> None:
    rows = [
        {"material": "stvk", "clamp": "whole", "box": box, "projection": projection}
        for box, projection in ((0.5, 0.02), (1.0, 0.01))
    ]
    assert boxes_in_order(rows) == ["stvk, clamp whole: a box of 1 is no harder"]
    assert boxes_in_order(rows[:1]) == []
