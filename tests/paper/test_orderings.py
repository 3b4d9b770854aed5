"""The orderings that `python -m paper --check` demands: what passes, and what is reported."""

from __future__ import annotations

from typing import Any

import pytest

from paper.orderings import errors_in_order, objectives_in_order


def errors(**means: tuple[int, float]) -> list[dict[str, Any]]:
    names = {"ours": "ours", "modal": "VM + MD", "larger": "VM + MD", "plain": "VM"}
    return [
        {
            "shape": "bar",
            "material": "stvk",
            "subspace": names[key],
            "d": d,
            "mean": mean,
            "projection": mean,
        }
        for key, (d, mean) in means.items()
    ]


def objectives(*values: tuple[str, int | None, float]) -> list[dict[str, Any]]:
    return [
        {"shape": "bar", "material": "stvk", "subspace": name, "d": d, "F": value}
        for name, d, value in values
    ]


def test_errors_in_the_right_order_pass() -> None:
    rows = errors(ours=(20, 0.1), modal=(20, 0.3), larger=(130, 0.05), plain=(20, 0.4))
    assert errors_in_order(rows) == [], "more dimensions may be better"


@pytest.mark.parametrize(
    ("modal", "plain", "message"),
    [
        (0.09, 0.4, "bar, stvk: VM + MD is better than ours, d = 20"),
        (0.3, 0.2, "bar, stvk: VM holds more than VM + MD, d = 20"),
    ],
)
def test_errors_in_another_order_are_reported(modal: float, plain: float, message: str) -> None:
    rows = errors(ours=(20, 0.1), modal=(20, modal), plain=(20, plain))
    assert errors_in_order(rows) == [message]


def test_objectives_in_the_right_order_pass() -> None:
    rows = objectives(
        ("full", None, 1.0), ("ours", 20, 1.2), ("biharmonic", 36, 5.0), ("biharmonic", 69, 2.0)
    )
    assert objectives_in_order(rows) == []


@pytest.mark.parametrize(
    ("ours", "first", "second", "message"),
    [
        (0.9, 5.0, 2.0, "bar, stvk: ours, d = 20, is below the minimum"),
        (1.2, 1.1, 1.05, "bar, stvk: biharmonic is better than ours, d = 36"),
        (1.2, 5.0, 6.0, "bar, stvk: biharmonic does not fall from d = 36"),
    ],
)
def test_objectives_in_another_order_are_reported(
    ours: float, first: float, second: float, message: str
) -> None:
    rows = objectives(
        ("full", None, 1.0),
        ("ours", 20, ours),
        ("biharmonic", 36, first),
        ("biharmonic", 69, second),
    )
    assert objectives_in_order(rows) == [message]
