"""Orderings that the tables must have, whatever their digits are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby, pairwise
from typing import Any

Rows = Sequence[dict[str, Any]]


def errors_in_order(rows: Rows) -> list[str]:
    """Faults of table 2: ours is best up to its dimension, and VM + MD projects better than VM.

    Modes and modal derivatives are compared by projections: with stiff handles, their reduced
    solutions may be as far from the full ones as the rest shape is.
    """
    faults = []
    for title, group in by_case(rows):
        ours = named(group, "ours")[0]
        for row in group:
            if row is not ours and row["d"] <= ours["d"] and row["mean"] <= ours["mean"]:
                faults.append(f"{title}: {row['subspace']} is better than ours, d = {row['d']}")
        for plain in named(group, "VM"):
            modal = [row for row in named(group, "VM + MD") if row["d"] == plain["d"]]
            faults += [
                f"{title}: VM holds more than VM + MD, d = {row['d']}"
                for row in modal
                if plain["projection"] < row["projection"]
            ]
    return faults


def objectives_in_order(rows: Rows) -> list[str]:
    """Faults of table 3.

    No subspace is below the full solution, ours is below the smallest of each rival, and rivals'
    objectives fall with d.
    """
    faults = []
    for title, group in by_case(rows):
        full, ours = named(group, "full")[0], named(group, "ours")[0]
        for row in group:
            if row["F"] < full["F"] * (1.0 - 1e-6):
                faults.append(f"{title}: {row['subspace']}, d = {row['d']}, is below the minimum")
        for name in ("biharmonic", "radial basis"):
            rivals = named(group, name)
            if rivals and rivals[0]["F"] <= ours["F"]:
                faults.append(f"{title}: {name} is better than ours, d = {rivals[0]['d']}")
            for before, after in pairwise(rivals):
                if after["F"] >= before["F"]:
                    faults.append(f"{title}: {name} does not fall from d = {before['d']}")
    return faults


def by_case(rows: Rows) -> Iterator[tuple[str, list[dict[str, Any]]]]:
    for (shape, material), group in groupby(rows, lambda row: (row["shape"], row["material"])):
        yield f"{shape}, {material}", list(group)


def named(rows: Rows, name: str) -> list[dict[str, Any]]:
    return [row for row in rows if row["subspace"] == name]
