"""What must hold in the figures, whatever their digits are."""

from __future__ import annotations

from .orderings import Rows


def figures_in_order(rows: Rows) -> list[str]:
    """Faults: a rival of at most our dimension, or the straight blend, is as near as ours."""
    ours = {_shape(row): row for row in rows if row["subspace"] == "ours"}
    faults = []
    for row in rows:
        best = ours[_shape(row)]
        small = row["subspace"] == "straight" or (
            row["subspace"] == "VM + MD" and row["d"] <= best["d"]
        )
        if small and row["error"] <= best["error"]:
            faults.append(
                f"figure {row['figure']}, {row['material']}, {row['parameters']}: "
                f"{row['subspace']} is as near as ours"
            )
    return faults


def _shape(row: dict[str, object]) -> tuple[object, ...]:
    return row["figure"], row["material"], row["parameters"]
