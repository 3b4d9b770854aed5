"""measured_ratio: the ratio of a model's errors to its projection errors."""

from __future__ import annotations

from ..reduction import InterpolationModel, PosingModel
from ..snapshots import Snapshots
from ..validation import projection_errors, unseen_errors
from .plan import Plan


def measured_ratio(model: PosingModel | InterpolationModel, unseen: Snapshots, plan: Plan) -> float:
    """Typical error of the model's solutions at unseen samples, divided by that of projections."""
    error = plan.typical(unseen_errors(model, unseen))
    return error / max(plan.typical(projection_errors(model, unseen)), 1e-12)
