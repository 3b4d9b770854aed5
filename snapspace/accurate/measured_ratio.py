"""measured_ratio: the ratio of a model's errors to its projection errors."""

from __future__ import annotations

from ..reduction import InterpolationModel, PosingModel, solved_coordinates
from ..snapshots import Snapshots
from ..validation import solution_errors
from .plan import Plan


def measured_ratio(model: PosingModel | InterpolationModel, unseen: Snapshots, plan: Plan) -> float:
    """Typical error of the model's solutions at unseen samples, divided by that of projections."""
    coordinates = solved_coordinates(model, unseen.parameters)
    errors, projections = solution_errors(model, unseen, coordinates).T
    return plan.typical(errors) / max(plan.typical(projections), 1e-12)
