"""What must hold for the limits, whatever their digits are."""

from __future__ import annotations

from itertools import groupby

from .orderings import Rows

#: Mirror images may be a little worse than nothing: modes also serve motions that nobody asks for.
SLACK = 1.05


def limits_in_order(rows: Rows) -> list[str]:
    """Faults: mirror images that hurt, responses that do not help, new samples that are worse."""
    faults = []
    for (limit, shape), group in groupby(rows, lambda row: (row["limit"], row["shape"])):
        errors = {row["variant"]: row["error"] for row in group}
        if limit == "symmetry":
            if errors["samples and mirror images"] >= SLACK * errors["samples"]:
                faults.append(f"symmetry, {shape}: mirror images hurt")
        elif limit == "other handles":
            if errors["old handles and linear responses"] >= errors["old handles"]:
                faults.append(f"other handles, {shape}: responses do not help")
            if errors["new samples"] >= errors["old handles"]:
                faults.append(f"other handles, {shape}: new samples are no better than the old")
    return faults
