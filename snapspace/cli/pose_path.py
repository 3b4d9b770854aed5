"""The path of `snapspace pose --path`: from rest to the motions of the command line."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..mesh import TetMesh
from ..problem import PosingProblem
from ..reduction import PosingModel
from ..session import FrameReport
from .console import notice, print_facts
from .motions import Motion

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class PosedPath:
    """Shapes (n, 3) of a path, with a report of each solve."""

    model: PosingModel
    shapes: list[FloatArray]
    reports: list[FrameReport]

    def as_json(self, files: list[Path]) -> dict[str, Any]:
        """The numbers with the keys of `snapspace pose --path --json`."""
        problem = self.model.problem
        frames = [
            {
                "status": report.status,
                "iterations": report.iterations,
                "value": report.value,
                "solve_ms": 1e3 * report.seconds,
                "inverted_tets": inverted_tets(problem, shape),
            }
            for shape, report in zip(self.shapes, self.reports, strict=True)
        ]
        return {"frames": frames, "written": [str(file) for file in files]}

    def print_report(self, files: list[Path]) -> None:
        """Prints a table for the user."""
        failed = [report for report in self.reports if not report.converged]
        if failed:
            notice(
                f"notice: {len(failed)} of {len(self.reports)} solves ended with "
                f"{failed[0].status}; those shapes may be poor"
            )
        solve = 1e3 * np.median([report.seconds for report in self.reports])
        more = f" and {len(files) - 1} more" if len(files) > 1 else ""
        facts = [
            ("shapes", f"{len(self.shapes)}, {len(self.shapes) - len(failed)} converged"),
            ("solve", f"{solve:.2f} ms"),
            (
                "written",
                f"{files[0]}{more}" if files else "nothing; -o DIR or -o FILE.gif keeps them",
            ),
        ]
        print_facts("posed", facts)


def posed_path(model: PosingModel, motions: Mapping[str, Motion], frames: int) -> PosedPath:
    """Solves `frames` shapes on the path from rest to the motions."""
    session = model.session()
    key = {
        name: (np.deg2rad(motion.euler or (0.0,) * 3), motion.translation or (0.0,) * 3)
        for name, motion in motions.items()
    }
    shapes, reports = [], []
    for report in session.animate([key], frames=frames):
        reports.append(report)
        shapes.append(session.vertices)
    return PosedPath(model, shapes, reports)


def inverted_tets(problem: PosingProblem, shape: FloatArray) -> int | None:
    """Number of inverted tets of a solid in a shape; None for a shell."""
    return problem.energy.inverted_tets(shape) if isinstance(problem.mesh, TetMesh) else None
