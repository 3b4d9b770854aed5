"""What must hold for the curves, whatever their digits are."""

from __future__ import annotations

from itertools import groupby, pairwise

from .orderings import Rows, named


def curves_in_order(rows: Rows) -> list[str]:
    """Faults: our error rises with d, or a rival of at most our dimension has a smaller one."""
    faults = []
    for kind, group in groupby(rows, lambda row: row["material"]):
        material = list(group)
        ours = named(material, "ours")
        for before, after in pairwise(ours):
            if after["error"] >= before["error"]:
                faults.append(f"{kind}: ours does not fall from d = {before['d']}")
        for row in material:
            if row["subspace"].startswith("ours"):
                continue
            larger = [best for best in ours if best["d"] >= row["d"]]
            if larger and row["error"] <= larger[0]["error"]:
                faults.append(f"{kind}: {row['subspace']} is better than ours, d = {row['d']}")
    return faults
