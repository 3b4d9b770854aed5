"""Figure 9: the faults that it reports, and its pictures."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from paper import figure9
from paper.figure9_orderings import errors_by_samples_in_order

FIGURES = {
    ("random", 13, 12): 0.030,
    ("random", 24, 12): 0.024,
    ("random", 80, 12): 0.020,
    ("random", 80, 18): 0.010,
    ("sobol", 80, 18): 0.011,
    ("greedy", 80, 18): 0.011,
    ("grid", 56, 18): 0.030,
}


def rows(changed: dict[tuple[str, int, int], float] | None = None) -> list[dict[str, Any]]:
    figures = FIGURES | (changed or {})
    return [
        {
            "shape": "lizard",
            "material": "stvk",
            "method": method,
            "samples": samples,
            "d": d,
            "mean": value,
            "deviation": 0.1 * value,
            "uniform": value,
        }
        for (method, samples, d), value in figures.items()
    ]


def test_errors_in_the_right_order_pass() -> None:
    assert errors_by_samples_in_order(rows()) == []
    few = rows({("random", 13, 12): 0.5})
    assert errors_by_samples_in_order(few) == [], "up to twice as many samples may be needed"


@pytest.mark.parametrize(
    ("key", "value", "message"),
    [
        (("random", 80, 18), 0.02, "errors do not fall from d = 12 to d = 18"),
        (("random", 24, 12), 0.041, "24 samples are too few for d = 12"),
        (("sobol", 80, 18), 0.021, "sobol samples are not like random ones, d = 18"),
        (("greedy", 80, 18), 0.004, "greedy samples are not like random ones, d = 18"),
    ],
)
def test_errors_in_another_order_are_reported(
    key: tuple[str, int, int], value: float, message: str
) -> None:
    found = errors_by_samples_in_order(rows({key: value}))
    assert found == [f"lizard, stvk: {message}"]


def test_each_material_has_two_pictures(tmp_path: Path) -> None:
    figure9.draw(rows(), tmp_path)
    names = sorted(path.name for path in tmp_path.iterdir())
    assert names == ["figure9_dimensions_stvk.png", "figure9_methods_stvk.png"]
