"""Orderings of table 1: all samples converge, and ours take less time than the paper's."""

from __future__ import annotations

from .orderings import Rows, by_case

#: Work before the first frame, in seconds.
PREPARATION = ("sampling, s", "coefficients, s")


def times_in_order(rows: Rows) -> list[str]:
    """Faults of table 1.

    Every sample converges, a sample takes less time than with Newton's method in the same run, and
    on the paper's shapes preparation and frames take less time than the paper prints.
    """
    faults = []
    for title, group in by_case(rows):
        methods = {row["method"].partition(",")[0]: row for row in group}
        ours, newton, paper = (methods.get(name) for name in ("ours", "Newton", "paper"))
        for row in group:
            if row["converged"] is not None and row["converged"] < row["solved"]:
                faults.append(
                    f"{title}: {row['converged']} of {row['solved']} samples of {row['method']} "
                    "converged"
                )
        if ours and newton and newton["s a sample"] <= ours["s a sample"]:
            faults.append(f"{title}: Newton's method is faster than our solver")
        if ours and paper:
            spent, printed = (sum(row[part] for part in PREPARATION) for row in (ours, paper))
            if printed <= spent:
                faults.append(
                    f"{title}: preparation takes {spent:.3g} s, {printed:.3g} s in the paper"
                )
            if paper["ms a frame"] <= ours["ms a frame"]:
                faults.append(f"{title}: a frame takes longer than in the paper")
    return faults
