"""Table 3: objective and gradient in the unreduced space, of reduced solutions.

The paper shows the poses (Fig. 7 and 8) and gives no numbers of them. Here it is one unseen motion
of each problem. Dimensions are the paper's; Newton's method begins at the projection of the full
solution, with a tolerance of 1e-7.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.pictures import Curve, chart, render_row, save_png, tint

from . import rivals
from .cached import training, unseen
from .cases import MATERIALS, read
from .cut import cut
from .minimisers import minimisers
from .orderings import Rows, by_case, named, objectives_in_order
from .result import Result, slug

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Column:
    """A column of the paper's table: (objective, gradient) of the full solution, ours, BC, RBF."""

    name: str
    samples: int
    ours: int
    dimensions: tuple[int, ...]
    full: tuple[float, float]
    our_paper: tuple[float, float]
    biharmonic: tuple[tuple[float, float], ...]
    radial: tuple[tuple[float, float], ...]
    up: str = "z"


DRAGON = Column(
    "dragon",
    300,
    40,
    (69, 114, 204, 384, 744),
    (4.37e-1, 8.51e-3),
    (1.03, 1.24),
    ((1.43e2, 5.87e2), (6.15e1, 1.31e2), (5.99e1, 7.85e1), (6.12, 1.06e1), (1.33, 4.40)),
    ((2.46e3, 8.15e3), (7.49e2, 3.73e3), (1.94e2, 9.18e2), (1.83e1, 2.43e2), (2.22, 3.72e1)),
)
ARMADILLO = Column(
    "armadillo",
    300,
    60,
    (138, 228, 408, 768),
    (1.42e3, 3.48e1),
    (9.12e3, 9.03e3),
    ((2.33e6, 5.02e5), (4.44e4, 8.24e4), (1.09e4, 3.27e3), (8.54e3, 7.59e2)),
    ((1.29e6, 9.42e5), (3.75e5, 1.58e5), (5.11e4, 4.40e4), (9.89e3, 8.00e3)),
    up="y",
)
#: How many of the dimensions the generated shapes take.
QUICK = 2


def run(*, quick: bool = False) -> Result:
    """Both columns, for the paper's material and for stable neo-Hookean."""
    result = Result("table3", "Table 3: objective and gradient norm in the unreduced space")
    for column in (DRAGON,) if quick else (DRAGON, ARMADILLO):
        _add(result, column, quick=quick)
    result.rows.sort(key=lambda row: MATERIALS.index(row["material"]))
    return result


def _add(result: Result, column: Column, *, quick: bool) -> None:
    columns = [_Judged(column, kind, quick=quick) for kind in MATERIALS]
    for judged in columns:
        judged.add(result, "full", None, judged.full, column.full)
        samples, ours = (60, 20) if quick else (column.samples, column.ours)
        found = ss.snapshot_pca(training(judged.problem, samples), dimension=ours)
        judged.minimise(result, "ours", found, column.our_paper)
    # the rivals know the mesh and the handles only: both materials share them
    for name, build, papers in (
        ("biharmonic", rivals.biharmonic_subspace, column.biharmonic),
        ("radial basis", rivals.radial_basis_subspace, column.radial),
    ):
        dimensions = column.dimensions[:QUICK] if quick else column.dimensions
        for d, paper in zip(dimensions, papers, strict=False):
            subspace = build(columns[0].problem, d)
            for judged in columns:
                judged.minimise(
                    result, name, subspace, paper, shown=d in (dimensions[0], dimensions[-1])
                )
    number = 7 if column is DRAGON else 8
    for judged in columns:
        picture = _picture(judged.problem, judged.shapes, column.up)
        result.pictures[f"figure{number}_{judged.kind}"] = picture


class _Judged:
    """A column in one material: its unseen motion, and the shapes that are shown of it."""

    def __init__(self, column: Column, kind: str, *, quick: bool) -> None:
        case = read(column.name, kind, quick=quick)
        assert isinstance(case.problem, ss.PosingProblem)
        self.kind, self.shape, self.problem = kind, case.shape, case.problem
        self.reference = unseen(self.problem, 1)
        self.full = self.reference.shapes[0]
        self.shapes = {"full": self.full}

    def minimise(
        self,
        result: Result,
        name: str,
        subspace: ss.AffineSubspace,
        paper: tuple[float, float],
        *,
        shown: bool = True,
    ) -> None:
        """Adds the row of the minimiser in a subspace."""
        shape = next(minimisers(subspace, self.reference))
        self.add(result, name, subspace.dimension, shape, paper)
        if shown:
            self.shapes[f"{name}, {subspace.dimension}"] = shape

    def add(
        self, result: Result, name: str, d: int | None, x: FloatArray, paper: tuple[float, float]
    ) -> None:
        """Adds a row: the objective of a shape, and the norm of its gradient."""
        value, gradient = self.problem.value_and_gradient(x, self.reference.parameters[0])
        known = paper if self.kind == "stvk" else (None, None)
        result.add(
            shape=self.shape,
            material=self.kind,
            subspace=name,
            d=d,
            **{"paper F": known[0], "F": value},
            **{"paper |grad F|": known[1], "|grad F|": float(np.linalg.norm(gradient))},
        )


faults = objectives_in_order


def draw(rows: Rows, folder: Path) -> None:
    """Writes table3_SHAPE_MATERIAL.png, the objective against d, and the shapes of Fig. 7 and 8."""
    for title, group in by_case(rows):
        (full,) = named(group, "full")
        curves = []
        for name in ("ours", "biharmonic", "radial basis"):
            points = named(group, name)
            values = [row["F"] for row in points]
            curves.append(Curve(name, [row["d"] for row in points], values))
        ends = [min(row["d"] for row in group if row["d"]), max(row["d"] or 0 for row in group)]
        curves.append(Curve("full solution", ends, [full["F"]] * 2, dashed=True))
        picture = chart(curves, title=title, x_name="d", y_name="objective F", size=(560, 380))
        shape, material = full["shape"], full["material"]
        save_png(folder / f"table3_{slug(shape)}_{material}.png", picture)


def _picture(
    problem: ss.PosingProblem, shapes: dict[str, FloatArray], up: str
) -> NDArray[np.uint8]:
    """The full solution, ours, and the rivals of the least and the greatest dimension."""
    reference = shapes["full"].reshape(-1, 3)
    return render_row(
        [cut(shape.reshape(-1, 3), reference) for shape in shapes.values()],
        problem.mesh.surface,
        labels=list(shapes),
        columns=len(shapes),
        colors=tint(len(reference), [handle.vertices for handle in problem.handles]),
        size=(260, 260),
        font_size=14,
        margin=0.04,
        azimuth=-60.0 if up == "z" else 30.0,
        up=up,
    )
