"""The orderings of the curves: what passes, and what is reported."""

from __future__ import annotations

import pytest

from paper.curves_orderings import curves_in_order


def rows(*values: tuple[str, int, float]) -> list[dict[str, object]]:
    return [
        {"material": "stvk", "subspace": name, "d": d, "error": error} for name, d, error in values
    ]


def test_rivals_may_be_better_with_more_dimensions() -> None:
    good = rows(
        ("ours", 12, 0.1), ("ours", 24, 0.01), ("ours, mass alone", 24, 0.001), ("VM", 36, 0.001)
    )
    assert curves_in_order(good) == []


@pytest.mark.parametrize(
    ("values", "fault"),
    [
        ([("ours", 12, 0.1), ("ours", 24, 0.1)], "stvk: ours does not fall from d = 12"),
        ([("ours", 24, 0.1), ("VM", 12, 0.1)], "stvk: VM is better than ours, d = 12"),
    ],
)
def test_broken_orderings_are_reported(values: list[tuple[str, int, float]], fault: str) -> None:
    assert curves_in_order(rows(*values)) == [fault]
