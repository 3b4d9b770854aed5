"""SolvedSamples: samples of a page's computations, from which the next one starts."""

from __future__ import annotations

import numpy as np

from ..problem import PosingProblem
from ..snapshots import Snapshots


class SolvedSamples:
    """The samples of the last computation and, if it was interrupted, of those before."""

    def __init__(self) -> None:
        self._snapshots: Snapshots | None = None

    def starts(self, problem: PosingProblem) -> Snapshots | None:
        """Samples that a computation for this problem can start from; None if there are none."""
        known = self._snapshots
        if known is None or known.problem.fingerprint != problem.fingerprint:
            return None
        return known if known.usable.any() else None

    def replace(self, snapshots: Snapshots) -> None:
        """Keeps only these samples."""
        self._snapshots = snapshots

    def add(self, snapshots: Snapshots) -> None:
        """Adds samples; they replace older ones at the same parameters."""
        old = self._snapshots
        if old is not None and old.problem.fingerprint == snapshots.problem.fingerprint:
            joined = snapshots.joined(old)
            _, first = np.unique(joined.parameters, axis=0, return_index=True)
            snapshots = joined.select(np.isin(np.arange(len(joined)), first))
        self._snapshots = snapshots
