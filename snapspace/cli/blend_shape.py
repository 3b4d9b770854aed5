"""BlendedShape: one blended shape, solved, measured and written."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..animation import write_shape
from ..reduction import InterpolationModel
from ..session import BlendingSession, FrameReport

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class BlendedShape:
    """The shape (n, 3) for weights (poses,), how it was found, and the linear blend if wanted.

    `certain` is that of the session: whether the energy certainly has a minimum there.
    """

    weights: FloatArray
    vertices: FloatArray
    linear: FloatArray | None
    report: FrameReport
    frame_ms: float
    volume: float
    inverted_tets: int
    certain: bool | None

    def as_json(self) -> dict[str, Any]:
        """The numbers with the keys of `snapspace blend --json`."""
        return {
            "weights": self.weights.tolist(),
            "status": self.report.status,
            "iterations": self.report.iterations,
            "value": self.report.value,
            "solve_ms": 1e3 * self.report.seconds,
            "frame_ms": self.frame_ms,
            "volume": self.volume,
            "inverted_tets": self.inverted_tets,
            "certain": self.certain,
        }


def shape_at(
    model: InterpolationModel,
    session: BlendingSession,
    weights: FloatArray,
    *,
    linear: bool,
    extrapolate: bool,
) -> BlendedShape:
    """Solves for weights, starting from the session's current shape."""
    begin = time.perf_counter()
    report = session.blend(weights, extrapolate=extrapolate)
    vertices = session.vertices
    frame_ms = 1e3 * (time.perf_counter() - begin)
    volumes = model.problem.volumes(vertices)
    straight = model.problem.linear_blend(weights, extrapolate=True) if linear else None
    return BlendedShape(
        weights,
        vertices,
        straight,
        report,
        frame_ms,
        float(volumes.sum()),
        int((volumes <= 0).sum()),
        session.certain,
    )


def write_blended(
    model: InterpolationModel, shape: BlendedShape, path: Path, *, up: str | None
) -> list[Path]:
    """Writes the surface or the tets, by the extension, and the linear blend beside the file."""
    files = [(path, shape.vertices)]
    if shape.linear is not None:
        files.append((path.with_name(f"{path.stem}-linear{path.suffix}"), shape.linear))
    for file, vertices in files:
        write_shape(file, model, vertices, up=up)
    return [file for file, _ in files]
