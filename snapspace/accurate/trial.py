"""Trial: a model that a search has tried."""

from __future__ import annotations

from dataclasses import dataclass

from ..reduction import InterpolationModel, PosingModel
from ..snapshots import Snapshots
from .step import Step


@dataclass(frozen=True)
class Trial:
    """A model that was tried, its errors, and the full solutions that it was compared with."""

    step: Step
    model: PosingModel | InterpolationModel
    unseen: Snapshots
