"""Cubature against the exact quartic: error, milliseconds, training and size by dimension.

python benchmarks/hyper_reduction.py --problem dragon elephant --samples 1000

Errors are against two truths: tight full solutions as `validate` makes them, and for each sample
the lower in energy of that one and of the full solution reached from the reduced one of the largest
model. St.Venant-Kirchhoff bodies have many minima, and the first is often not the lowest. Poses are
reached in one jump from rest, and (drag) in a straight line of 20 frames, against the first truth.
Rows with a closure are sessions with `closure=True` of the model above; a call is `set_parameters`,
with what sets the handles and the closure, warm its solve alone.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import common
import numpy as np
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace.mesh import mass_norms
from snapspace.snapshots import DisplacementRows, SampleReport

COLUMNS = ("d", "method", "samples", "tets", "mean", "median", "max", "median*", "mean*")
COLUMNS += ("drag median", "drag mean", "call ms")
COLUMNS += ("warm ms", "evaluations", "cold ms", "training s", "model MB", "held-out")
#: Frames of a drag from rest to a held-out pose.
DRAG = 20


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", nargs="+", default=["dragon", "elephant"])
    parser.add_argument("--samples", type=int, default=1000)
    parser.add_argument("--dimensions", type=int, nargs="+", default=[20, 40, 60, 120, 250])
    parser.add_argument("--quartic-up-to", type=int, default=40, help="largest d of the quartic")
    parser.add_argument("--validate", type=int, default=30, help="held-out parameters")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    results = {name: table_of(name, args) for name in args.problem}
    if args.json:
        print(json.dumps(results))
        return
    for name, rows in results.items():
        table = Table(*COLUMNS, title=f"{name}; * against the lower of two full solutions")
        for row in rows:
            table.add_row(*(f"{x:.4g}" if isinstance(x, float) else str(x) for x in row.values()))
        Console(width=220).print(table)


def table_of(name: str, args: argparse.Namespace) -> list[dict[str, Any]]:
    """A row per model, the largest first solved for the second truth."""
    problem = common.read_problem(name)
    parameters = ss.sample(problem.domain, args.samples, method="sobol", seed=args.seed)
    snapshots = common.solved(problem, parameters)
    snapshots = snapshots.select(snapshots.converged)
    reference = common.references(problem, args.validate)
    reference = reference.select(reference.converged)
    dimensions = sorted(d for d in args.dimensions if d <= len(snapshots))
    basis = ss.snapshot_pca(snapshots, dimension=dimensions[-1])
    rows, truths = [], None
    for d in reversed(dimensions):
        for method in ("cubature", "quartic"):
            if method == "quartic" and d > args.quartic_up_to:
                continue
            model, seconds = built(problem, basis.leading(d), snapshots, method)
            if truths is None:
                shapes, _ = solutions(model, reference)
                truths = [reference.displacements.array(), lower(reference, shapes)]
            for closure in (True, False):
                row = row_of(model, reference, truths, seed=args.seed, closure=closure)
                row["method"] = method + (" + closure" if closure else "")
                row["training_seconds"] = seconds
                rows.append(row)
    return rows[::-1]


def built(
    problem: ss.PosingProblem, subspace: ss.AffineSubspace, snapshots: ss.Snapshots, method: str
) -> tuple[ss.PosingModel, float]:
    """A model, and the seconds it took."""
    begin = time.perf_counter()
    if method == "cubature":
        model = ss.hyper_reduce(problem, subspace, snapshots)
    else:
        model = ss.reduce(problem, subspace, snapshots=snapshots)
    return model, time.perf_counter() - begin


def solutions(
    model: ss.PosingModel, reference: ss.Snapshots, *, frames: int = 1, **options: Any
) -> tuple[np.ndarray, float]:
    """Displacements (k, 3n) of reduced solves from rest, and the median ms of their last frames.

    With several frames the handles go there in a straight line. Options are those of the session.
    """
    session, shapes, seconds = model.session(**options), [], []
    for w in reference.parameters:
        session.reset()
        for frame in range(1, frames + 1):
            report = session.set_parameters(w * frame / frames)
        seconds.append(report.seconds)
        shapes.append(session.vertices.reshape(-1) - model.problem.base)
    return np.array(shapes), 1e3 * float(np.median(seconds))


def lower(reference: ss.Snapshots, shapes: np.ndarray) -> np.ndarray:
    """Of the references and the full solutions reached from shapes (k, 3n), those of lower F."""
    problem = reference.problem
    reports = [SampleReport("carried", 0, 0, 0.0, 0.0, 0.0, 0.0, 0)] * len(shapes)
    known = ss.Snapshots(
        problem, reference.parameters, DisplacementRows(shapes, shapes.shape[1]), reports
    )
    options = ss.SolverOptions(tolerance=1e-9, max_iterations=5000)
    others = ss.solve_snapshots(problem, reference.parameters, options=options, known=known)
    best = reference.displacements.array()
    other = others.displacements.array()
    for k, (one, two) in enumerate(zip(reference.reports, others.reports, strict=True)):
        if two.converged and two.value < one.value:
            best[k] = other[k]
    return best


def row_of(
    model: ss.PosingModel,
    reference: ss.Snapshots,
    truths: list[np.ndarray],
    *,
    seed: int,
    closure: bool,
) -> dict[str, Any]:
    """The figures of one model, in the order of COLUMNS."""
    mass = model.subspace.mass
    shapes, cold = solutions(model, reference, closure=closure)
    errors, best = (relative(mass, shapes, x) for x in truths)
    dragged = relative(
        mass, solutions(model, reference, frames=DRAG, closure=closure)[0], truths[0]
    )
    session, evaluations, calls = model.session(closure=closure), [], []
    for w in path(model, seed + 1):
        begin = time.perf_counter()
        evaluations.append(session.set_parameters(w).evaluations)
        calls.append(1e3 * (time.perf_counter() - begin))
    warm, _ = common.drag(model, frames=300, seed=seed + 1, closure=closure)
    with tempfile.TemporaryDirectory() as folder:
        size = model.save(Path(folder) / "model.snapspace").stat().st_size
    record = model.provenance.get("cubature", {})
    held = record.get("held_out", {})
    return {
        "dimension": model.dimension,
        "method": "",
        "samples": len(model.training_parameters),
        "tets": record.get("tets", "all"),
        "error_mean": float(errors.mean()),
        "error_median": float(np.median(errors)),
        "error_max": float(errors.max()),
        "best_median": float(np.median(best)),
        "best_mean": float(best.mean()),
        "drag_median": float(np.median(dragged)),
        "drag_mean": float(dragged.mean()),
        "call_ms": float(np.median(calls)),
        "warm_ms": float(np.median(warm)),
        "warm_evaluations": float(np.median(evaluations)),
        "cold_ms": cold,
        "training_seconds": 0.0,
        "model_megabytes": size / 1e6,
        "held_out_displacement": held.get("displacement_median", 0.0),
    }


def relative(mass: Any, shapes: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Relative M-norm errors (k,) of displacements (k, 3n)."""
    errors: np.ndarray = mass_norms(mass, (shapes - truth).T) / mass_norms(mass, truth.T)
    return errors


def path(model: ss.PosingModel, seed: int) -> np.ndarray:
    """The parameters of `common.drag` over 120 frames."""
    corners = ss.sample(model.problem.domain, 7, seed=seed)[:3]
    steps = np.arange(60)[:, None] / 60.0
    return np.vstack([a + (b - a) * steps for a, b in pairwise(corners)])


if __name__ == "__main__":
    main()
