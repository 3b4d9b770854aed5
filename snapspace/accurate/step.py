"""Step: one model that was tried."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Step:
    """One model that was tried.

    samples : solved by then
    dimension : d
    projection : error of the held-out samples' projections, the mean for blends and the median for
        motions
    error : of their reduced solutions, the same
    mean, ninth : mean and 90th percentile of the latter
    unseen, typical : what was held out, and what of its errors `error` is, for people
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
        """How much farther reduced solutions are off than projections."""
        return self.error / max(self.projection, 1e-12)

    def __str__(self) -> str:
        return (
            f"{self.samples} samples, d = {self.dimension}: error of unseen {self.unseen} "
            f"{100 * self.error:.2g} %, of their projections {100 * self.projection:.2g} %"
        )
