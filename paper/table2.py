"""Table 2: relative L2 errors of our subspaces, and of vibration modes and modal derivatives.

The paper does not define its error or its motions. Here errors are those of unseen parameters,
uniform in the domain, relative to the displacement from tau. All subspaces are evaluated exactly,
and Newton's method begins at the projection of the full solution. The errors of the projections,
lower bounds for all reduced solutions, are beside them.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

import snapspace as ss
from snapspace.pictures import Curve, chart, save_png

from . import rivals
from .cached import cached_subspace, training, unseen
from .cases import MATERIALS, read
from .minimisers import projection_errors, relative_errors
from .orderings import Rows, by_case, errors_in_order, named
from .result import Result, slug

UNSEEN = 10


@dataclass(frozen=True)
class Row:
    """A row of the paper's table: name, samples, our dimension, those of rivals, paper's errors."""

    name: str
    samples: int
    ours: int
    rivals: tuple[int, ...]
    paper: tuple[float, ...]


ROWS = (
    Row("dragon", 300, 40, (40, 130), (0.042, 0.151, 0.045)),
    Row("elephant", 200, 45, (45, 93), (0.009, 0.101, 0.056)),
    Row("helix", 30, 20, (20, 100, 260), (0.002, 0.263, 0.083, 0.004)),
)
#: For generated shapes.
QUICK = (
    Row("dragon", 60, 20, (20, 40), (0.042, 0.151, 0.045)),
    Row("helix", 30, 20, (20, 60), (0.002, 0.263, 0.083)),
)


def run(*, quick: bool = False) -> Result:
    """All rows, for the paper's material and for stable neo-Hookean."""
    result = Result("table2", "Table 2: relative L2 error on unseen parameters")
    for kind in MATERIALS:
        for row in QUICK if quick else ROWS:
            _add(result, row, kind, quick=quick)
    return result


def _add(result: Result, row: Row, kind: str, *, quick: bool) -> None:
    case = read(row.name, kind, quick=quick)
    problem = case.problem
    reference = unseen(problem, UNSEEN)
    wanted = [("ours", ss.snapshot_pca(training(problem, row.samples), dimension=row.ours))]
    wanted += [
        ("VM + MD", cached_subspace("modal", problem, d, rivals.modal_subspace)) for d in row.rivals
    ]
    if isinstance(problem, ss.PosingProblem):  # beyond the paper: modes alone
        wanted.append(
            ("VM", cached_subspace("vibration", problem, row.rivals[1], rivals.vibration_subspace))
        )
    paper = row.paper if kind == "stvk" else ()
    for (name, subspace), known in zip_longest(wanted, paper):
        errors = relative_errors(subspace, reference)
        result.add(
            shape=case.shape,
            material=kind,
            subspace=name,
            d=subspace.dimension,
            paper=known,
            projection=float(projection_errors(subspace, reference).mean()),
            mean=float(errors.mean()),
            deviation=float(errors.std()),
            unseen=len(errors),
        )


faults = errors_in_order


def draw(rows: Rows, folder: Path) -> None:
    """Writes table2_SHAPE_MATERIAL.png: errors and projections against the dimension."""
    for title, group in by_case(rows):
        curves = []
        for name in ("ours", "VM + MD"):
            points = named(group, name)
            dimensions = [row["d"] for row in points]
            curves.append(Curve(name, dimensions, [row["mean"] for row in points]))
            known = [row["projection"] for row in points]
            curves.append(Curve(f"{name}, projections", dimensions, known, dashed=True))
        picture = chart(curves, title=title, x_name="d", y_name="relative error", size=(560, 380))
        shape, material = group[0]["shape"], group[0]["material"]
        save_png(folder / f"table2_{slug(shape)}_{material}.png", picture)
