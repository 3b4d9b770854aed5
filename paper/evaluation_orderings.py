"""Orderings that the table of evaluations must have."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby
from typing import Any

from .orderings import Rows

#: Error of an exact evaluation that the tolerance of the solves may leave.
SOLVED = 1e-4


def faults(rows: Rows) -> list[str]:
    """Faults of the table: errors fall with the size of each evaluation, and cubatures are best.

    The exact quartic adds no error, and a cubature adds less than each coarse mesh that does as
    much arithmetic or more. Few clusters of rotations may beat few tets; as many as have the cost
    of the largest cubature may not. Medians are compared: single solutions may be in another
    minimum.
    """
    found = []
    for title, group in _groups(rows):
        for row in _named(group, "exact quartic"):
            if row["median"] > SOLVED:
                found.append(f"{title}: the exact quartic adds an error of {row['median']:.2g}")
        for name in ("cubature", "coarse mesh", "rotation clusters"):
            sized = sorted(_named(group, name), key=lambda row: int(row["elements"]))
            if sized and sized[-1]["median"] >= sized[0]["median"]:
                found.append(f"{title}: {name} does not gain from {sized[-1]['elements']} elements")
        largest = max(_named(group, "cubature"), key=lambda row: int(row["elements"]))
        found += [
            f"{title}: {row['elements']} clusters are better than cubatures"
            for row in _named(group, "rotation clusters")
            if row["multiply-adds"] >= largest["multiply-adds"]
            and row["median"] <= largest["median"]
        ]
        for row in _named(group, "coarse mesh"):
            cheaper = [
                other["median"]
                for other in _named(group, "cubature")
                if other["multiply-adds"] <= row["multiply-adds"]
            ]
            if cheaper and min(cheaper) >= row["median"]:
                found.append(
                    f"{title}: a coarse mesh of {row['elements']} tets is better than cubatures"
                )
    return found


def _groups(rows: Rows) -> Iterator[tuple[str, list[dict[str, Any]]]]:
    for (shape, material, d), group in groupby(
        rows, lambda row: (row["shape"], row["material"], row["d"])
    ):
        yield f"{shape}, {material}, d = {d}", list(group)


def _named(rows: Rows, name: str) -> list[dict[str, Any]]:
    return [row for row in rows if row["evaluation"] == name]
