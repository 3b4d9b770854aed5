"""What solves have cost."""

from __future__ import annotations

import numpy as np

from snapspace import Snapshots


def evaluations(snapshots: Snapshots) -> float:
    """Of a sample, mean."""
    return float(np.mean([report.evaluations for report in snapshots.reports]))
