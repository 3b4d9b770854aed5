"""Cubature against the exact quartic: error, milliseconds, training and size by dimension.

python benchmarks/hyper_reduction.py --problem dragon elephant --samples 1000
python benchmarks/hyper_reduction.py --problem tips:0 --material stable-neo-hookean --tets 1000 2000

Errors are against tight full solutions, as in `validate`. Poses are reached in one jump from rest,
and (drag) along a straight line of 20 frames. "Call" is all of `set_parameters` in a drag, "warm"
its solve alone. Only St.Venant-Kirchhoff has an exact quartic; materials.py has the errors of other
materials.
"""

from __future__ import annotations

import argparse
import json
import tempfile
import time
from pathlib import Path
from typing import Any

import common
import numpy as np
import problems
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace.mesh import mass_norms

COLUMNS = ("d", "energy", "samples", "tets", "median", "mean", "max", "drag median", "drag mean")
COLUMNS += ("call ms", "warm ms", "evaluations", "cold ms", "training s", "model MB", "held-out")
#: Frames of a drag from rest to a held-out pose.
DRAG = 20
#: Frames of the path on which "warm" is measured, and those whose evaluations are counted.
FRAMES, COUNTED = 300, 120


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", nargs="+", default=["dragon", "elephant"])
    parser.add_argument("--material", default="stvk")
    parser.add_argument("--samples", type=int, default=1000)
    parser.add_argument("--tolerance", type=float, default=1e-5, help="tolerance of the samples")
    parser.add_argument("--settling", type=float, help="settling, instead of a tolerance")
    parser.add_argument("--dimensions", type=int, nargs="+", default=[20, 40, 60, 120, 250])
    parser.add_argument(
        "--tets", type=int, nargs="+", help="tets of cubatures; default: that of reduce"
    )
    parser.add_argument("--exact-up-to", type=int, default=40, help="largest d of the quartic")
    parser.add_argument("--validate", type=int, default=30, help="number of held-out parameters")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    results = {name: table_of(name, args) for name in args.problem}
    if args.json:
        print(json.dumps(results))
        return
    for name, rows in results.items():
        table = Table(*COLUMNS, title=f"{name}, {args.material}")
        for row in rows:
            table.add_row(*(f"{x:.4g}" if isinstance(x, float) else str(x) for x in row.values()))
        Console(width=200).print(table)


def table_of(name: str, args: argparse.Namespace) -> list[dict[str, Any]]:
    """One row per model."""
    problem = common.with_material(problems.read(name), args.material)
    parameters = ss.sample(problem.domain, args.samples, method="sobol", seed=args.seed)
    stop = {"tolerance": args.tolerance} if args.settling is None else {"settling": args.settling}
    snapshots = common.solved(problem, parameters, **stop)
    snapshots = snapshots.select(snapshots.converged)
    reference = common.references(problem, args.validate)
    reference = reference.select(reference.converged)
    dimensions = sorted(d for d in args.dimensions if d <= len(snapshots))
    basis = ss.snapshot_pca(snapshots, dimension=dimensions[-1])
    rows = []
    for d in dimensions:
        for energy in ("exact", "cubature"):
            if energy == "exact" and (d > args.exact_up_to or args.material != "stvk"):
                continue
            for tets in (args.tets or [None]) if energy == "cubature" else [None]:
                begin = time.perf_counter()
                model = ss.reduce(
                    problem, basis.leading(d), snapshots=snapshots, energy=energy, tets=tets
                )
                seconds = time.perf_counter() - begin
                rows.append(row_of(model, reference, energy, seconds, seed=args.seed))
    return rows


def row_of(
    model: ss.PosingModel, reference: ss.Snapshots, energy: str, training: float, *, seed: int
) -> dict[str, Any]:
    """The figures of one model, in the order of COLUMNS."""
    mass, truth = model.subspace.mass, reference.displacements.array()
    shapes, cold = common.solutions(model, reference)
    errors = relative(mass, shapes, truth)
    dragged = relative(mass, common.solutions(model, reference, frames=DRAG)[0], truth)
    session, evaluations, calls = model.session(), [], []
    for w in common.path(model.problem, frames=FRAMES, seed=seed + 1)[:COUNTED]:
        begin = time.perf_counter()
        evaluations.append(session.set_parameters(w).evaluations)
        calls.append(1e3 * (time.perf_counter() - begin))
    warm, _ = common.drag(model, frames=FRAMES, seed=seed + 1)
    with tempfile.TemporaryDirectory() as folder:
        size = model.save(Path(folder) / "model.snapspace").stat().st_size
    record = model.provenance.get("cubature", {})
    return {
        "dimension": model.dimension,
        "energy": energy,
        "samples": len(model.training_parameters),
        "tets": record.get("tets", "all"),
        "error_median": float(np.median(errors)),
        "error_mean": float(errors.mean()),
        "error_max": float(errors.max()),
        "drag_median": float(np.median(dragged)),
        "drag_mean": float(dragged.mean()),
        "call_ms": float(np.median(calls)),
        "warm_ms": float(np.median(warm)),
        "warm_evaluations": float(np.median(evaluations)),
        "cold_ms": cold,
        "training_seconds": training,
        "model_megabytes": size / 1e6,
        "held_out_displacement": record.get("held_out", {}).get("displacement_median", 0.0),
    }


def relative(mass: Any, shapes: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Relative M-norm errors (k,) of displacements (k, 3n)."""
    errors: np.ndarray = mass_norms(mass, shapes - truth) / mass_norms(mass, truth)
    return errors


if __name__ == "__main__":
    main()
