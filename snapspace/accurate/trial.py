"""Trial: a model that a search has tried."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from ..calibration import calibrate
from ..reduction import InterpolationModel, PosingModel
from ..snapshots import Snapshots
from ..validation import unseen_errors, with_lower_minima
from .plan import Plan
from .step import Step


@dataclass(frozen=True)
class Trial:
    """A model that was tried, its errors, and the full solutions that it was compared with."""

    step: Step
    model: PosingModel | InterpolationModel
    unseen: Snapshots


def trial_of(
    model: PosingModel | InterpolationModel,
    unseen: Snapshots,
    plan: Plan,
    *,
    samples: int,
    projection: float,
    threads: int | None,
) -> Trial:
    """Compares a model with unseen full solutions; these become lower ones where it finds them.

    Numbers are those of `Step`.
    """
    errors = unseen_errors(model, unseen)
    unseen, lower = with_lower_minima(model, unseen, errors=errors, threads=threads)
    if lower:
        errors = unseen_errors(model, unseen)
    step = Step(
        samples=samples,
        dimension=model.dimension,
        projection=projection,
        error=plan.typical(errors),
        mean=float(errors.mean()),
        ninth=float(np.quantile(errors, 0.9)),
        unseen=plan.unseen_name,
        typical=plan.typical_name,
    )
    return Trial(step, model, unseen)


def recorded(best: Trial, target: float, steps: Sequence[Step]) -> Trial:
    """The trial with its model calibrated by the unseen solutions, if there are enough.

    The model's provenance has the target and all steps.
    """
    record = {
        "target_error": target,
        "reached": best.step.error <= target,
        "step": asdict(best.step),
        "steps": [asdict(step) for step in steps],
    }
    provenance: dict[str, Any] = {**best.model.provenance, "accurate": record}
    model = replace(best.model, provenance=provenance)
    if len(best.unseen) > 1:
        model = calibrate(model, reference=best.unseen, thorough=False)
    return replace(best, model=model)
