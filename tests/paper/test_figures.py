"""Figures: what their rows must show, and how rivals that leave the picture are drawn."""

from __future__ import annotations

import numpy as np

from paper.cut import OUTSIDE, cut
from paper.figures_orderings import figures_in_order


def rows(**errors: float) -> list[dict[str, object]]:
    kinds = {"ours": ("ours", 20), "modal": ("VM + MD", 20), "larger": ("VM + MD", 40)}
    kinds["straight"] = ("straight", None)
    same = {"figure": 4, "material": "stvk", "parameters": "0.5 0.5"}
    return [
        {**same, "subspace": kinds[key][0], "d": kinds[key][1], "error": error}
        for key, error in errors.items()
    ]


def test_more_dimensions_may_be_nearer() -> None:
    assert figures_in_order(rows(ours=0.1, modal=0.3, larger=0.05, straight=0.4)) == []


def test_a_rival_of_the_same_dimension_may_not_be_nearer() -> None:
    (fault,) = figures_in_order(rows(ours=0.1, modal=0.1))
    assert fault == "figure 4, stvk, 0.5 0.5: VM + MD is as near as ours"
    (fault,) = figures_in_order(rows(ours=0.1, straight=0.05))
    assert "straight is as near" in fault


def test_shapes_are_cut_at_a_box_around_the_reference() -> None:
    reference = np.array([[0.0, 0.0, 0.0], [3.0, 4.0, 0.0]])
    inside = reference + 0.1
    np.testing.assert_array_equal(cut(inside, reference), inside)
    far = np.array([[-10.0, 1.0, 0.0], [1.0, 90.0, 0.0]])
    margin = 5.0 * OUTSIDE
    np.testing.assert_allclose(cut(far, reference), [[-margin, 1, 0], [1, 4 + margin, 0]])
