"""Solved: a finished sample, passed from a solver to the run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .snapshots import SampleReport

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Solved:
    """One finished sample.

    sample : number of the sample in the run
    displacement : (3n,) from the problem's `base`, as the solver left it: not yet registered
    report : SampleReport, never cancelled
    """

    sample: int
    displacement: FloatArray
    report: SampleReport
