"""Orderings of figure 9: what the paper says of samples, dimensions and methods."""

from __future__ import annotations

from itertools import pairwise

from .orderings import Rows, by_case

#: With this many samples for each dimension, the error is at most twice that with the most.
SAMPLES_PER_DIMENSION = 2.0
#: How far a mean may be above another that the paper takes for the same.
ALIKE = 2.0


def errors_by_samples_in_order(rows: Rows) -> list[str]:
    """Faults of figure 9, of mean errors.

    With the most samples they fall with d, about d samples are enough for d dimensions, and methods
    with as many samples are alike.
    """
    faults = []
    for title, group in by_case(rows):
        random = [row for row in group if row["method"] == "random"]
        most = max(row["samples"] for row in random)
        last = {row["d"]: row for row in random if row["samples"] == most}
        for lower, higher in pairwise(sorted(last)):
            if last[higher]["mean"] >= last[lower]["mean"]:
                faults.append(f"{title}: errors do not fall from d = {lower} to d = {higher}")
        for d, row in last.items():
            few = [
                other
                for other in random
                if other["d"] == d and other["samples"] <= SAMPLES_PER_DIMENSION * d
            ]
            if few and few[-1]["mean"] > ALIKE * row["mean"]:
                faults.append(f"{title}: {few[-1]['samples']} samples are too few for d = {d}")
        faults += _unlike(title, [row for row in group if row["samples"] == most])
    return faults


def _unlike(title: str, rows: Rows) -> list[str]:
    """Methods whose errors on the random samples differ from those of random sampling."""
    random = {row["d"]: row["uniform"] for row in rows if row["method"] == "random"}
    return [
        f"{title}: {row['method']} samples are not like random ones, d = {row['d']}"
        for row in rows
        if not 1.0 / ALIKE < row["uniform"] / random[row["d"]] < ALIKE
    ]
