"""The Elephant's error: which motions and which clamp give the paper's 0.009 at d = 45.

The paper gives neither the range of the trunk's motions nor the clamped region. Here the box of
motions is scaled, and the clamp is the problem's or the half of it that is farthest from the
moving handles. "error" is that of the reduced solve, "projection" the least that the subspace
allows.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import snapspace as ss
from snapspace.pictures import Curve, chart, save_png

from .cached import training, unseen
from .cases import MATERIALS, read
from .elephant_orderings import boxes_in_order
from .minimisers import projection_errors, relative_errors
from .orderings import Rows
from .result import Result

PAPER = 0.009
SAMPLES, DIMENSION, UNSEEN = 200, 45, 6
QUICK_SAMPLES, QUICK_DIMENSION = 40, 16
#: Shares of the box's half widths, for each clamp.
BOXES = {"whole": (0.25, 0.5, 0.75, 1.0), "half": (0.5, 1.0)}
QUICK_BOXES = {"whole": (0.5, 1.0), "half": (1.0,)}


def run(*, quick: bool = False) -> Result:
    """Errors by material, clamp and box."""
    result = Result("elephant", "The Elephant: error against the range of motions")
    count, dimension = (QUICK_SAMPLES, QUICK_DIMENSION) if quick else (SAMPLES, DIMENSION)
    for kind in MATERIALS:
        case = read("elephant", kind, quick=quick)
        assert isinstance(case.problem, ss.PosingProblem)
        for clamp, boxes in (QUICK_BOXES if quick else BOXES).items():
            for share in boxes:
                problem = variant(case.problem, clamp=clamp, share=share)
                reference = unseen(problem, UNSEEN)
                subspace = ss.snapshot_pca(training(problem, count), dimension=dimension)
                errors = relative_errors(subspace, reference)
                result.add(
                    shape=case.shape,
                    material=kind,
                    clamp=clamp,
                    box=share,
                    d=dimension,
                    paper=PAPER if kind == "stvk" and not case.generated else None,
                    projection=float(projection_errors(subspace, reference).mean()),
                    error=float(errors.mean()),
                    median=float(np.median(errors)),
                )
    return result


def variant(problem: ss.PosingProblem, *, clamp: str, share: float) -> ss.PosingProblem:
    """The problem with a share of its box, and the whole clamp or half of it."""
    handles = problem.handles
    first = handles.names[0]
    if clamp == "half":
        vertices = problem.mesh.vertices
        fixed = next(iter(handles)).vertices
        moving = problem.centroids[1:].mean(axis=0)
        away = np.linalg.norm(vertices[fixed] - moving, axis=1)
        handles = handles.replacing(first, fixed[away >= np.median(away)])
    bounds = share * problem.domain.bounds
    domain = ss.HandleBox(translation=bounds[:, :3], angle=bounds[:, 3:], moving=len(bounds))
    return ss.PosingProblem(
        problem.mesh,
        handles,
        domain=domain,
        material=problem.material,
        stiffness=problem.stiffness,
    )


faults = boxes_in_order


def draw(rows: Rows, folder: Path) -> None:
    """Writes elephant.png: errors and projections against the box, by material."""
    curves = []
    for kind in dict.fromkeys(row["material"] for row in rows):
        points = [row for row in rows if (row["material"], row["clamp"]) == (kind, "whole")]
        boxes = [row["box"] for row in points]
        curves.append(Curve(kind, boxes, [row["error"] for row in points]))
        known = [row["projection"] for row in points]
        curves.append(Curve(f"{kind}, projections", boxes, known, dashed=True))
    title = f"{rows[0]['shape']}, d = {rows[0]['d']}"
    picture = chart(curves, title=title, x_name="share of the box", y_name="relative error")
    save_png(folder / "elephant.png", picture)
