"""check_reference: checks that known full solutions can validate a model."""

from __future__ import annotations

import numpy as np

from ..reduction import ReducedModel, check_model
from ..snapshots import Snapshots, check_snapshots


def check_reference(model: ReducedModel, reference: Snapshots, *, who: str = "validate") -> None:
    """Raises a ValueError in the name of `who` unless the model has not seen these solutions.

    There must be at least one. All must be of the model's problem, and converged. None may be at a
    training parameter of the model, where its error says nothing about other parameters.
    """
    check_model(model, who)
    check_snapshots(reference, who, "reference")
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
            f"{who}: {bad.size} of {len(reference)} reference samples are not full solutions: the "
            f"status of sample {bad[0]} is {reference.reports[bad[0]].status}, but all must have "
            "converged; leave the others out with reference.select(reference.converged)"
        )
    trained = {row.tobytes() for row in model.training_parameters}
    seen = [i for i, row in enumerate(reference.parameters) if row.tobytes() in trained]
    if seen:
        raise ValueError(
            f"{who}: {len(seen)} of {len(reference)} reference samples, the first is {seen[0]}, "
            "are at training parameters of the model, where its error says nothing about other "
            "parameters; leave them out"
        )
