"""The end of every build: errors at parameters that it was not trained on."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, TypeVar

import numpy as np

from ..accurate import plan_of
from ..calibration import calibrate
from ..mesh import TetMesh
from ..reduction import InterpolationModel, PosingModel
from ..snapshots import Snapshots
from ..validation import Validation, solved_reference, validate, with_lower_minima
from .console import notice
from .progress import sample_progress

Model = TypeVar("Model", bound=PosingModel | InterpolationModel)

#: Number of full solutions that judge a model with given samples and dimension. They are solved as
#: tightly as those of `validate`; each takes two to four times as long as a sample.
COUNT = 8


def judged(
    model: PosingModel | InterpolationModel, known: Snapshots | None, *, threads: int | None
) -> Validation | None:
    """Validates with known full solutions, or with eight new ones; None if none converges.

    New solutions are at the first parameters of `snapspace validate`, where there are no samples.
    """
    if known is None:
        try:
            with sample_progress("unseen samples", total=COUNT) as progress:
                known = solved_reference(
                    model.problem, samples=COUNT, threads=threads, progress=progress
                )
        except ValueError as error:
            notice(f"notice: the errors of unseen samples are unknown: {error}")
            return None
    lowest, lower = with_lower_minima(model, known, threads=threads)
    return replace(validate(model, reference=lowest), lower_minima=lower)


def with_estimates(model: Model, validation: Validation | None) -> Model:
    """The model with error estimates for its frames, calibrated with the validation."""
    if validation is None or len(validation.reference) < 2:
        return model
    return calibrate(model, reference=validation.reference, thorough=False)


def unseen_record(
    model: PosingModel | InterpolationModel, validation: Validation, snapshots: Snapshots
) -> dict[str, Any]:
    """The entry "unseen" of a model's provenance.

    Parameters
    ----------
    model : PosingModel or InterpolationModel
        The model that was built.
    validation : Validation
        Its errors at unseen samples.
    snapshots : Snapshots
        All samples that were solved for it.
    """
    plan = plan_of(model.problem)
    record = {
        "name": plan.unseen_name,
        "typical": plan.typical_name,
        "samples": len(validation.error),
        "median": float(np.median(validation.error)),
        "mean": float(validation.error.mean()),
        "ninth": float(np.quantile(validation.error, 0.9)),
        "projection_median": float(np.median(validation.projection_error)),
    }
    if not isinstance(model.problem.mesh, TetMesh):
        return record
    full = [report.inverted_tets for report in validation.reference.reports]
    return record | {
        "inverted_tets": {
            "samples": _counts([report.inverted_tets for report in snapshots.reports]),
            "unseen": _counts(full),
            "frames": _counts(validation.inverted_tets.tolist()),
        },
    }


def _counts(inverted: list[int]) -> dict[str, float]:
    """Number of shapes with inverted tets, and their median and largest number in a shape."""
    return {
        "shapes": len(inverted),
        "with_some": sum(count > 0 for count in inverted),
        "median": float(np.median(inverted)),
        "max": max(inverted),
    }
