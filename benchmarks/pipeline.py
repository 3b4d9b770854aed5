"""The pipeline on one problem: seconds per stage, memory, file size, errors, ms per frame.

python benchmarks/pipeline.py --problem dragon --samples 300 --dimension 40
"""

from __future__ import annotations

import argparse
import tempfile
import time
from pathlib import Path

import common
import numpy as np

import snapspace as ss
from snapspace.cli.memory import peak_memory_bytes

PAPER = {  # tables 1 and 2: seconds for snapshots and coefficients, ms per frame, error
    "dragon": "paper: 8121 s + 5162 s, 9.9 ms per frame, error 0.042",
    "elephant": "paper: 3608 s + 5663 s, 21 ms per frame, error 0.009",
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", default="dragon")
    parser.add_argument("--samples", type=int, default=300)
    parser.add_argument("--dimension", type=int, default=40)
    parser.add_argument("--validate", type=int, default=30, help="number of held-out samples")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()

    problem = common.read_problem(args.problem)
    laps = [time.perf_counter()]
    parameters = ss.sample(problem.domain, args.samples, seed=args.seed)
    snapshots = ss.solve_snapshots(problem, parameters, progress=common.progress)
    laps.append(time.perf_counter())
    subspace = ss.snapshot_pca(snapshots, dimension=args.dimension)
    laps.append(time.perf_counter())
    model = ss.reduce(problem, subspace, snapshots=snapshots)
    laps.append(time.perf_counter())
    peak = peak_memory_bytes()
    with tempfile.TemporaryDirectory() as folder:
        path = model.save(Path(folder) / "model.snapspace")
        size = path.stat().st_size
        model = ss.load(path)
    solve, frame = common.drag(model, frames=600, seed=args.seed + 1)
    validation = ss.validate(model, samples=args.validate, progress=common.progress)

    stages = np.diff(laps)
    errors = validation.as_json(model.dimension)
    result = {
        "problem": args.problem,
        "vertices": len(problem.mesh.vertices),
        "tets": len(problem.mesh.tets),
        "samples": args.samples,
        "converged": int(snapshots.converged.sum()),
        "iterations_mean": float(np.mean([r.iterations for r in snapshots.reports])),
        "evaluations_mean": float(np.mean([r.evaluations for r in snapshots.reports])),
        "inverted_tets_max": max(r.inverted_tets for r in snapshots.reports),
        "seconds": dict(zip(("snapshots", "basis", "reduction"), stages.tolist(), strict=True)),
        "peak_memory_bytes": peak,
        "model_bytes": size,
        "drag_ms": {
            "solve_median": float(np.median(solve)),
            "frame_median": float(np.median(frame)),
            "frame_p99": float(np.percentile(frame, 99)),
        },
        "validation": errors,
    }
    rows = [
        ("vertices / tets", f"{result['vertices']} / {result['tets']}", ""),
        ("samples converged", f"{result['converged']} of {args.samples}", ""),
        ("iterations, mean", result["iterations_mean"], ""),
        ("inverted tets, max", result["inverted_tets_max"], ""),
        ("snapshots, s", float(stages[0]), "<= 480"),
        ("basis + coefficients, s", float(stages[1] + stages[2]), "<= 60"),
        ("peak memory, GiB", "not known" if peak is None else peak / 2**30, "<= 4"),
        ("model file, MB", size / 1e6, "<= 60"),
        ("projection error, median", errors["projection_error"]["median"], "<= 0.01"),
        ("reduced error, mean", errors["error"]["mean"], ""),
        ("reduced error, median", errors["error"]["median"], ""),
        ("reduced error, max", errors["error"]["max"], ""),
        ("energy ratio, median", errors["energy_ratio"]["median"], ""),
        ("solve in a drag, ms median", float(np.median(solve)), ""),
        ("frame in a drag, ms median", float(np.median(frame)), "<= 4"),
        ("frame in a drag, ms 99 %", float(np.percentile(frame, 99)), ""),
    ]
    common.show(f"{args.problem}; {PAPER.get(args.problem, '')}", rows, result, args.json)


if __name__ == "__main__":
    main()
