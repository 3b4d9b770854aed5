"""SolvedSamples: what computations of a page have solved, for the next one to start from."""

from __future__ import annotations

import numpy as np

from ..problem import PosingProblem
from ..snapshots import Snapshots, carried

#: Samples that are carried over to other handles: a second on the Dragon, and starts are
#: interpolated from no more than these. Sobol samples come in an order that any number is spread.
CARRIED = 64


class SolvedSamples:
    """The samples of the last computation; and those before, if it was interrupted."""

    def __init__(self) -> None:
        self._snapshots: Snapshots | None = None

    def starts(self, problem: PosingProblem) -> Snapshots | None:
        """What a computation for this problem can start from; None if there is nothing.

        Samples of other handles are carried over where all of these are handles still: without the
        pull of one that is gone they are no better than the rest shape, see `carried`.
        """
        known = self._snapshots
        if known is None or not known.usable.any():
            return None
        old = known.problem
        if old.fingerprint == problem.fingerprint:
            return known
        assert isinstance(old, PosingProblem)
        if not _regions(old) <= _regions(problem):
            return None
        usable = np.flatnonzero(known.usable)[:CARRIED]
        return carried(known.select(np.isin(np.arange(len(known)), usable)), problem)

    def replace(self, snapshots: Snapshots) -> None:
        """These are all that is kept."""
        self._snapshots = snapshots

    def add(self, snapshots: Snapshots) -> None:
        """Keeps these too, in place of older ones at the same parameters."""
        old = self._snapshots
        if old is not None and old.problem.fingerprint == snapshots.problem.fingerprint:
            joined = snapshots.joined(old)
            _, first = np.unique(joined.parameters, axis=0, return_index=True)
            snapshots = joined.select(np.isin(np.arange(len(joined)), first))
        self._snapshots = snapshots


def _regions(problem: PosingProblem) -> set[bytes]:
    return {handle.vertices.tobytes() for handle in problem.handles}
