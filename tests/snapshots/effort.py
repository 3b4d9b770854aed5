"""The cost of solves."""

from __future__ import annotations

import numpy as np

from snapspace import Snapshots


def evaluations(snapshots: Snapshots) -> float:
    """The mean number of evaluations per sample."""
    return float(np.mean([report.evaluations for report in snapshots.reports]))
