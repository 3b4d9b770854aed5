"""Cubature against the exact quartic: error, milliseconds, training and size by dimension.

python benchmarks/hyper_reduction.py --problem dragon elephant --samples 1000

Errors are against three truths: tight full solutions as `validate` makes them (the first); for each
sample the lowest in energy of these, of solutions from rest and from the four nearest training
samples, and of the one reached from the reduced solution of the largest model; and (own) the full
solution that is reached from the row's reduced one, the minimum that it approximates.
St.Venant-Kirchhoff bodies have many minima, and the first is often not the lowest. Poses are
reached in one jump from rest, and (drag) in a straight line of 20 frames, against the first truth;
(anew) after `solve_anew` at its end, against the lowest.
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
from lowest_solutions import lowest_solutions, solved_from
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace.mesh import mass_norms

COLUMNS = ("d", "method", "samples", "tets", "mean", "median", "max", "median*", "mean*")
COLUMNS += ("own median", "own mean", "drag median", "drag mean", "anew*", "call ms")
COLUMNS += ("warm ms", "evaluations", "cold ms", "training s", "model MB", "held-out")
#: Frames of a drag from rest to a held-out pose.
DRAG = 20


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", nargs="+", default=["dragon", "elephant"])
    parser.add_argument("--samples", type=int, default=1000)
    parser.add_argument("--tolerance", type=float, default=1e-5, help="of the samples")
    parser.add_argument("--settling", type=float, help="of the samples, instead of a tolerance")
    parser.add_argument("--dimensions", type=int, nargs="+", default=[20, 40, 60, 120, 250])
    parser.add_argument("--tets", type=int, help="of each cubature; default: 8 d, at most 1000")
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
        table = Table(*COLUMNS, title=f"{name}; * against the lowest full solutions known")
        for row in rows:
            apart = row.pop("first_to_lowest")
            table.add_row(*(f"{x:.4g}" if isinstance(x, float) else str(x) for x in row.values()))
        table.caption = "the first are {:.4f} / {:.4f} (median / mean) from the lowest".format(
            *apart
        )
        Console(width=250).print(table)


def table_of(name: str, args: argparse.Namespace) -> list[dict[str, Any]]:
    """A row per model, the largest first solved for the second truth."""
    problem = common.read_problem(name)
    parameters = ss.sample(problem.domain, args.samples, method="sobol", seed=args.seed)
    stop = {"tolerance": args.tolerance} if args.settling is None else {"settling": args.settling}
    snapshots = common.solved(problem, parameters, **stop)
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
            model, seconds = built(problem, basis.leading(d), snapshots, method, args.tets)
            if truths is None:
                shapes, _ = solutions(model, reference)
                lowest = lowest_solutions(model, snapshots, reference, shapes)
                truths = [reference.displacements.array(), lowest]
            for closure in (True, False):
                row = row_of(model, reference, truths, seed=args.seed, closure=closure)
                row["method"] = method + (" + closure" if closure else "")
                row["training_seconds"] = seconds
                rows.append(row)
    return rows[::-1]


def built(
    problem: ss.PosingProblem,
    subspace: ss.AffineSubspace,
    snapshots: ss.Snapshots,
    method: str,
    tets: int | None,
) -> tuple[ss.PosingModel, float]:
    """A model, and the seconds it took."""
    begin = time.perf_counter()
    if method == "cubature":
        model = ss.hyper_reduce(problem, subspace, snapshots, tets=tets)
    else:
        model = ss.reduce(problem, subspace, snapshots=snapshots)
    return model, time.perf_counter() - begin


def solutions(
    model: ss.PosingModel,
    reference: ss.Snapshots,
    *,
    frames: int = 1,
    anew: bool = False,
    **options: Any,
) -> tuple[np.ndarray, float]:
    """Displacements (k, 3n) of reduced solves from rest, and the median ms of their last frames.

    With several frames the handles go there in a straight line; anew: `solve_anew` follows. Options
    are those of the session.
    """
    session, shapes, seconds = model.session(**options), [], []
    for w in reference.parameters:
        session.reset()
        for frame in range(1, frames + 1):
            report = session.set_parameters(w * frame / frames)
        if anew:
            report = session.solve_anew()
        seconds.append(report.seconds)
        shapes.append(session.vertices.reshape(-1) - model.problem.base)
    return np.array(shapes), 1e3 * float(np.median(seconds))


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
    own = relative(mass, shapes, solved_from(reference, shapes).displacements.array())
    dragged, released = (
        relative(mass, solutions(model, reference, frames=DRAG, anew=anew, closure=closure)[0], x)
        for anew, x in zip((False, True), truths, strict=True)
    )
    apart = relative(mass, *truths)
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
        "own_median": float(np.median(own)),
        "own_mean": float(own.mean()),
        "drag_median": float(np.median(dragged)),
        "drag_mean": float(dragged.mean()),
        "released_mean": float(released.mean()),
        "call_ms": float(np.median(calls)),
        "warm_ms": float(np.median(warm)),
        "warm_evaluations": float(np.median(evaluations)),
        "cold_ms": cold,
        "training_seconds": 0.0,
        "model_megabytes": size / 1e6,
        "held_out_displacement": held.get("displacement_median", 0.0),
        "first_to_lowest": (float(np.median(apart)), float(apart.mean())),
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
