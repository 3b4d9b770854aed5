"""Validation: errors and costs of a model at unseen parameters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import TetMesh
from ..snapshots import Snapshots

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Validation:
    """Errors and costs at unseen parameters, (k,) for the k samples whose full solve converged.

    error : |x_red - x_full|_M / |x_full - tau|_M of the reduced solve from tau, the rest or mean
    shape; for interpolation after rigid registration
    projection_error : the same for the M-projection of x_full onto the subspace, the least possible
    error
    energy_ratio : objective of the reduced solution divided by that of the full one
    iterations : iterations of the session
    solve_ms, frame_ms : milliseconds of the solve, and of the solve and all vertices
    inverted_tets : number of tets without positive volume in the reduced solution; for the full
    solutions see `reference.reports`
    reference : the full solutions, for the next validation; `save_snapshots` writes them
    lower_minima : number of full solutions that are lower minima, found from frames
    """

    error: FloatArray
    projection_error: FloatArray
    energy_ratio: FloatArray
    iterations: NDArray[np.int64]
    solve_ms: FloatArray
    frame_ms: FloatArray
    inverted_tets: NDArray[np.int64]
    reference: Snapshots
    lower_minima: int = 0

    def as_json(self, dimension: int) -> dict[str, Any]:
        """The figures with the keys of `snapspace validate --json`."""
        return {
            "samples": len(self.error),
            "dimension": dimension,
            "error": _statistics(self.error),
            "projection_error": _statistics(self.projection_error),
            "energy_ratio": _statistics(self.energy_ratio),
            "iterations": _statistics(self.iterations),
            "solve_ms": {
                "median": float(np.median(self.solve_ms)),
                "max": float(self.solve_ms.max()),
            },
            "frame_ms": {
                "median": float(np.median(self.frame_ms)),
                "max": float(self.frame_ms.max()),
            },
            "inverted_tets": {
                "frames_max": int(self.inverted_tets.max()),
                "samples_max": max(report.inverted_tets for report in self.reference.reports),
            }
            if isinstance(self.reference.problem.mesh, TetMesh)
            else None,
            "lower_minima": self.lower_minima,
        }

    def __repr__(self) -> str:
        e = self.error
        figures = f"median {np.median(e):.3g}, mean {np.mean(e):.3g}, maximum {np.max(e):.3g}"
        return f"Validation(errors of {len(e)} samples: {figures})"


def _statistics(values: NDArray[Any]) -> dict[str, float]:
    return {
        "mean": float(np.mean(values)),
        "median": float(np.median(values)),
        "ninth": float(np.quantile(values, 0.9)),
        "std": float(np.std(values)),
        "max": float(np.max(values)),
    }
