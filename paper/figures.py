"""Figures 2 to 6: shapes in our subspace beside the full solution and the rivals.

The paper shows pictures only, without the parameters of its shapes. Here they are printed: weights
of blends, or strong motions inside the sampled box. Errors are defined as in Table 2, relative to
the displacement from tau; blends are moved rigidly to where the full solution is. The straight
blend moves vertices along lines.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import snapspace as ss
from snapspace.mesh import mass_norms
from snapspace.pictures import render_row, tint
from snapspace.validation.unseen import reference_options

from . import rivals
from .cached import cached_snapshots, cached_subspace, training
from .cases import MATERIALS, Case, read
from .cut import cut
from .figures_orderings import figures_in_order
from .minimisers import minimisers
from .orderings import Rows
from .result import Result

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Figure:
    """A figure of the paper.

    number : number of the figure; case : name of its problem
    samples, ours : samples and dimension of our subspace
    modal : dimensions of vibration modes with modal derivatives
    shares : for each shape, the weights of the poses or the shares of the box's half widths
    view : options for `render_row`
    """

    number: int
    case: str
    samples: int
    ours: int
    modal: tuple[int, ...]
    shares: tuple[tuple[float, ...], ...]
    view: dict[str, Any] = field(default_factory=dict)


#: A head that is pulled aside and turned, in shares of the box.
TURNED = (0.6, -0.5, 0.3, 0.5, -0.6, 0.9)
FIGURES = (
    Figure(2, "lion", 12, 6, (6, 24), ((0.3, 0.7),), {"up": "y", "azimuth": 65.0}),
    Figure(3, "dog_head", 100, 20, (20, 60), (TURNED,), {"azimuth": -60.0}),
    Figure(4, "helix", 30, 20, (20, 100), ((0.8, 0.2), (0.6, 0.4), (0.3, 0.7)), {"azimuth": -60.0}),
    Figure(5, "dog", 20, 10, (10, 40), ((0.6, 0.2, 0.2), (0.0, 0.5, 0.5)), {"azimuth": -60.0}),
    Figure(6, "dragon", 300, 40, (40, 130), (TURNED,), {"azimuth": -60.0}),
)
QUICK = (
    Figure(4, "helix", 30, 12, (12, 40), ((0.3, 0.7),), {"azimuth": -60.0}),
    Figure(6, "dragon", 60, 20, (20, 40), (TURNED,), {"azimuth": -42.0}),
)


def run(*, quick: bool = False) -> Result:
    """All figures in the paper's material and in stable neo-Hookean."""
    result = Result("figures", "Figures 2 to 6: relative L2 error of the drawn shapes")
    for kind in MATERIALS:
        for figure in QUICK if quick else FIGURES:
            _add(result, figure, kind, quick=quick)
    return result


faults = figures_in_order


def draw(rows: Rows, folder: Path) -> None:
    """Draws nothing: the result has pictures of the shapes."""


def _add(result: Result, figure: Figure, kind: str, *, quick: bool) -> None:
    case = read(figure.case, kind, quick=quick)
    problem = case.problem
    parameters = np.array(figure.shares)
    if isinstance(problem, ss.PosingProblem):
        count = problem.domain.half_widths.size // 6
        parameters = np.tile(parameters, count) * problem.domain.half_widths
    reference = cached_snapshots(problem, parameters, reference_options(problem))
    columns = _columns(figure, case, reference)
    tau = ss.snapshot_pca(training(problem, figure.samples), dimension=1)
    size = mass_norms(tau.mass, reference.shapes - tau.tau)
    errors = {}
    for (name, d), shapes in columns.items():
        missed = mass_norms(tau.mass, shapes - reference.shapes) / size
        errors[name, d] = missed
        for share, error in zip(figure.shares, missed, strict=True):
            result.add(
                figure=figure.number,
                shape=case.shape,
                material=kind,
                parameters=" ".join(f"{x:g}" for x in share),
                subspace=name,
                d=d,
                error=float(error),
            )
    result.pictures[f"figure{figure.number}_{kind}"] = _picture(figure, problem, columns, errors)


def _columns(
    figure: Figure, case: Case, reference: ss.Snapshots
) -> dict[tuple[str, int | None], FloatArray]:
    """Shapes (k, 3n) by subspace and dimension."""
    problem = case.problem
    found: dict[tuple[str, int | None], FloatArray] = {("full", None): reference.shapes}
    ours = ss.snapshot_pca(training(problem, figure.samples), dimension=figure.ours)
    found["ours", ours.dimension] = np.array(list(minimisers(ours, reference)))
    for d in figure.modal:
        modal = cached_subspace("modal", problem, d, rivals.modal_subspace)
        found["VM + MD", d] = np.array(list(minimisers(modal, reference)))
    if isinstance(problem, ss.InterpolationProblem):
        blends = [problem.linear_blend(w).reshape(-1) for w in reference.parameters]
        found["straight", None] = np.array(blends)
        for key, shapes in found.items():  # a blend has no place of its own
            pairs = zip(shapes, reference.shapes, strict=True)
            found[key] = np.array([_placed(shape, full, problem) for shape, full in pairs])
    return found


def _placed(shape: FloatArray, full: FloatArray, problem: ss.InterpolationProblem) -> FloatArray:
    """A shape (3n,) moved rigidly to where the full solution is."""
    motion = ss.rigid_registration(shape, full, problem.mass())
    return np.asarray(motion.apply(shape.reshape(-1, 3)).reshape(-1))


def _picture(
    figure: Figure,
    problem: ss.PosingProblem | ss.InterpolationProblem,
    columns: dict[tuple[str, int | None], FloatArray],
    errors: dict[tuple[str, int | None], FloatArray],
) -> NDArray[np.uint8]:
    """One row of shapes for each parameter, one column for each subspace."""
    shapes, labels = [], []
    reference = columns["full", None]
    for row in range(len(figure.shares)):
        for (name, d), column in columns.items():
            shapes.append(cut(column[row].reshape(-1, 3), reference[row].reshape(-1, 3)))
            title = name if d is None else f"{name}, d = {d}"
            labels.append(title if name == "full" else f"{title}: {_percent(errors[name, d][row])}")
    colors = None
    if isinstance(problem, ss.PosingProblem):
        regions = [handle.vertices for handle in problem.handles]
        colors = tint(len(problem.mesh.vertices), regions)
    return render_row(
        shapes,
        problem.mesh.surface,
        labels=labels,
        columns=len(columns),
        colors=colors,
        size=(300, 280),
        font_size=15,
        margin=0.04,
        **figure.view,
    )


def _percent(share: float) -> str:
    percent = 100.0 * share
    return f"{percent:.0f} %" if percent >= 10.0 else f"{percent:.2g} %"
