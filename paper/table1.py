"""Table 1: the cost of samples, coefficients and frames, here and in the paper.

Samples and dimensions are the paper's. "ours" is what Snapspace does by default. "Newton, BFGS" is
the paper's way of solving samples (sec. 4.2) and frames (sec. 6.2), by our code and in the same
run: Newton's method solves few samples from the middle of the sequence, each from the nearest of
the first half, and the seconds are scaled to all of them. The Armadillo takes the Dinosaur's place.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import snapspace as ss

from .cached import timed_training
from .cases import MATERIALS, Case, read
from .live import Live, drag
from .newton import newton_samples
from .orderings import Rows
from .result import Result
from .table1_orderings import times_in_order
from .timing import timed


@dataclass(frozen=True)
class Row:
    """A row of the paper's table.

    name : name of our case
    shape : the paper's shape, if it is another
    vertices, tets : in thousands
    samples, dimension : numbers of samples and modes
    sampling, coefficients : seconds
    iterations : Newton iterations for a sample
    per_iteration : milliseconds of a BFGS iteration
    per_frame : BFGS iterations in a frame
    """

    name: str
    vertices: float
    tets: float
    samples: int
    sampling: float
    iterations: float
    dimension: int
    coefficients: float
    per_iteration: float
    per_frame: float
    shape: str = ""


ROWS = (
    Row("lion", 13, 65, 4, 26.0, 28.0, 6, 1.18, 0.057, 7.0),
    Row("helix", 1, 2.5, 30, 27.0, 13.0, 20, 5.88, 0.6, 3.0),
    Row("dog", 32, 122, 20, 477.0, 13.0, 10, 25.0, 0.6, 3.0),
    Row("centaur", 16, 54, 40, 561.0, 17.0, 24, 726.0, 1.16, 6.0),
    Row("armadillo", 27, 107, 50, 2099.0, 12.0, 40, 2124.0, 1.0, 10.0, shape="Dinosaur"),
    Row("dragon", 32, 121, 300, 8121.0, 19.0, 40, 5162.0, 1.1, 9.0),
    Row("elephant", 24, 82, 200, 3608.0, 12.0, 45, 5663.0, 2.63, 8.0),
    Row("dog_head", 32, 122, 200, 4862.0, 25.0, 17, 380.0, 0.25, 8.0),
)
#: The rows, samples and dimensions of generated shapes.
QUICK = ("centaur", "armadillo", "dragon")
QUICK_SAMPLES, QUICK_DIMENSION = 30, 20
#: Samples that Newton's method solves, on meshes of usual size and on small ones.
NEWTON, NEWTON_SMALL = 2, 8
SMALL_TETS = 10_000


def run(*, quick: bool = False) -> Result:
    """All rows, for the paper's material and for stable neo-Hookean."""
    result = Result("table1", "Table 1: samples, coefficients and frames")
    for kind in MATERIALS:
        for row in ROWS:
            if not quick or row.name in QUICK:
                _add(result, row, kind, quick=quick)
    return result


def _add(result: Result, row: Row, kind: str, *, quick: bool) -> None:
    case = read(row.name, kind, quick=quick)
    if kind == "stvk" and not case.generated:
        _add_printed(result, row, case)
    count = min(row.samples, QUICK_SAMPLES) if quick else row.samples
    dimension = min(row.dimension, QUICK_DIMENSION) if quick else row.dimension
    problem = case.problem
    snapshots, seconds = timed_training(problem, count)

    def make() -> ss.PosingModel | ss.InterpolationModel:
        subspace = ss.snapshot_pca(snapshots, dimension=dimension)
        return ss.reduce(problem, subspace, snapshots=snapshots)

    model, coefficients = timed(make)
    mesh = problem.mesh
    size = {"vertices": len(mesh.vertices), "tets": len(mesh.cells)}
    result.add(
        **{"shape": case.shape, "material": kind, "method": "ours"},
        **size,
        **_sampling(snapshots, seconds, count),
        d=dimension,
        **_model(case.fitting, coefficients),
        **_frames(drag(model)),
    )
    few, seconds = newton_samples(
        snapshots, NEWTON_SMALL if len(mesh.cells) < SMALL_TETS else NEWTON
    )
    is_exact = model.cubature is None  # frames of a cubature are solved by BFGS anyway
    result.add(
        **{"shape": case.shape, "material": kind},
        method="Newton, BFGS" if is_exact else "Newton",
        **size,
        **_sampling(few, seconds, count),
        d=dimension,
        **_model(None, None),
        **_frames(drag(model, minimizer="bfgs") if is_exact else None),
    )


def _add_printed(result: Result, row: Row, case: Case) -> None:
    """The row as the paper has it."""
    method = f"paper, {row.shape}" if row.shape else "paper"
    result.add(
        **{"shape": case.shape, "material": "stvk", "method": method},
        **{"vertices": f"{row.vertices:g}k", "tets": f"{row.tets:g}k"},
        **{"solved": row.samples, "converged": None, "sampling, s": row.sampling},
        **{"s a sample": row.sampling / row.samples, "iterations": row.iterations},
        d=row.dimension,
        **_model(None, row.coefficients),
        **_frames(Live(row.per_frame, row.per_iteration, row.per_frame * row.per_iteration)),
    )


def _sampling(snapshots: ss.Snapshots, seconds: float, count: int) -> dict[str, Any]:
    """Columns of solved samples; the seconds of the sampling are those of all samples."""
    solved = len(snapshots)
    return {
        "solved": solved,
        "converged": int(snapshots.converged.sum()),
        "sampling, s": seconds / solved * count,
        "s a sample": seconds / solved,
        "iterations": sum(r.iterations for r in snapshots.reports) / solved,
    }


def _model(fitting: float | None, coefficients: float | None) -> dict[str, Any]:
    return {"fits, s": fitting, "coefficients, s": coefficients}


def _frames(live: Live | None) -> dict[str, Any]:
    return {
        "iterations a frame": live and live.iterations,
        "ms an iteration": live and live.per_iteration,
        "ms a frame": live and live.milliseconds,
    }


faults = times_in_order


def draw(rows: Rows, folder: Path) -> None:
    """Draws nothing: a table needs no picture."""
