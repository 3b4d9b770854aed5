"""Step: one model that was tried."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Step:
    """The size and the errors of one model that was tried.

    samples : number of samples solved so far
    dimension : d
    projection : relative error of the held-out samples' projections, the mean for blends and the
        median for motions
    error : the same of their reduced solutions
    mean, ninth : mean and 90th percentile of the errors of the reduced solutions
    unseen, typical : names for the user: what was held out ("motions"), and which statistic `error`
        is ("median")
    """

    samples: int
    dimension: int
    projection: float
    error: float
    mean: float
    ninth: float
    unseen: str
    typical: str

    @property
    def ratio(self) -> float:
        """Ratio of the error of reduced solutions to that of projections."""
        return self.error / max(self.projection, 1e-12)

    def __str__(self) -> str:
        return (
            f"{self.samples} samples, d = {self.dimension}: error of unseen {self.unseen} "
            f"{100 * self.error:.2g} %, of their projections {100 * self.projection:.2g} %"
        )
