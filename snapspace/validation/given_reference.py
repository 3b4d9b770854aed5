"""check_reference: whether known full solutions can judge a model."""

from __future__ import annotations

import numpy as np

from ..reduction import ReducedModel
from ..snapshots import Snapshots


def check_reference(model: ReducedModel, reference: Snapshots, *, who: str = "validate") -> None:
    """ValueError of `who` unless these are full solutions which the model has not seen.

    They must be of the model's problem, at least one, all converged, and at other parameters than
    those that the model was made of: there its error says nothing about other parameters.
    """
    own, theirs = model.problem, reference.problem
    if theirs.fingerprint != own.fingerprint:
        raise ValueError(
            f"{who}: the reference is of another problem, {theirs!r} instead of {own!r}; mesh, "
            "handles or poses, material and domain must all be the same; solve a new reference"
        )
    if len(reference) == 0:
        raise ValueError(f"{who}: the reference has no samples, but at least one is needed")
    bad = np.flatnonzero(~reference.converged)
    if bad.size:
        raise ValueError(
            f"{who}: {bad.size} of {len(reference)} reference samples are no full solutions: "
            f"sample {bad[0]} is {reference.reports[bad[0]].status}, but all must have converged; "
            "leave the others out with reference.select(reference.converged)"
        )
    trained = {row.tobytes() for row in model.training_parameters}
    seen = [i for i, row in enumerate(reference.parameters) if row.tobytes() in trained]
    if seen:
        raise ValueError(
            f"{who}: {len(seen)} of {len(reference)} reference samples, the first is {seen[0]}, "
            "are at parameters that the model was made of, where its error says nothing about "
            "others; leave them out"
        )
