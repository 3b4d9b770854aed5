"""PoseFits: poses of a tet mesh that match surfaces, and how well they match."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class PoseFit:
    """How the fit of one pose ended.

    name : name of the pose
    rms, max : distance between the fitted surface and its target, relative to the diagonal of the
        rest shape's bounding box; rms is weighted by area
    inverted_tets : number of tets with det F <= 0; zero for every status
    smallest_stretch, largest_stretch : extreme singular values of F over all tets
    stages : number of values of the surface stiffness that were tried
    iterations : Newton steps of all stages
    seconds : wall time
    status : one of converged, max_iterations, stiffness_limit, line_search_failed; a shape that did
        not converge is valid, but its surface is farther from the target than the goal
    """

    name: str
    rms: float
    max: float
    inverted_tets: int
    smallest_stretch: float
    largest_stretch: float
    stages: int
    iterations: int
    seconds: float
    status: str

    @property
    def converged(self) -> bool:
        """Whether the surface met the goal."""
        return self.status == "converged"

    def summary(self) -> str:
        """One line: distances, stretches, time, and the status if it did not converge."""
        text = (
            f"{self.name}: surface within {self.rms:.1e} rms, {self.max:.1e} max of the diagonal; "
            f"stretches {self.smallest_stretch:.2f} to {self.largest_stretch:.1f}, "
            f"{self.inverted_tets} inverted tets, {self.seconds:.1f} s"
        )
        return text if self.converged else f"{text}, {self.status}"


@dataclass(frozen=True, eq=False)
class PoseFits:
    """Poses of one mesh.

    shapes : (k, n, 3) vertices, in the frame of the rest shape
    reports : one PoseFit per shape
    """

    shapes: FloatArray
    reports: Sequence[PoseFit]

    def __repr__(self) -> str:
        missed = sum(not report.converged for report in self.reports)
        left = f", {missed} of them farther than the goal" if missed else ""
        worst = max((report.rms for report in self.reports), default=0.0)
        return f"PoseFits({len(self)} poses{left}, surfaces within {worst:.1e} rms)"

    def __len__(self) -> int:
        return len(self.reports)
