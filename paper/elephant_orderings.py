"""What must hold for the Elephant, whatever the digits are."""

from __future__ import annotations

from itertools import groupby, pairwise

from .orderings import Rows


def boxes_in_order(rows: Rows) -> list[str]:
    """Faults: a larger box has smaller projection errors."""
    faults = []
    for (kind, clamp), group in groupby(rows, lambda row: (row["material"], row["clamp"])):
        for before, after in pairwise(group):
            if after["projection"] <= before["projection"]:
                faults.append(f"{kind}, clamp {clamp}: a box of {after['box']:g} is no harder")
    return faults
