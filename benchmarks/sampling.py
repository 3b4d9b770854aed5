"""Random, Sobol and greedy samples: errors at unseen parameters, by number and by time.

python benchmarks/sampling.py --problem dragon --samples 200
"""

from __future__ import annotations

import argparse
import json
import time
from typing import Any

import common
import numpy as np
from rich.console import Console
from rich.table import Table

import snapspace as ss
from snapspace.validation import REFERENCE_TOLERANCE

METHODS = ("random", "sobol", "greedy")
SIZES = (20, 40)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--problem", default="dragon")
    parser.add_argument("--samples", type=int, default=200)
    parser.add_argument("--methods", nargs="+", choices=METHODS, default=METHODS)
    parser.add_argument("--unseen", type=int, default=32, help="number of held-out samples")
    parser.add_argument("--reduced", type=int, default=20, help="d of the reduced solves")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--threads", type=int)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()

    problem = common.read_problem(args.problem)
    unseen = unseen_snapshots(problem, args.unseen, threads=args.threads)
    counts = [k for k in (64, 128, 192, 256, 320) if k < args.samples] + [args.samples]
    rows: list[dict[str, Any]] = []
    for method in args.methods:
        solved, seconds = solve(problem, method, args)
        for count in counts:
            row = {"method": method, "samples": count, **seconds(count)}
            rows.append(row | errors(solved, unseen, count, args.reduced, threads=args.threads))
    if args.json:
        print(json.dumps({"problem": args.problem, "rows": rows}))
        return
    table = Table(*rows[0], title=f"{args.problem}; errors are median / mean / max")
    for row in rows:
        table.add_row(*(text(value) for value in row.values()))
    Console(width=160).print(table)


def unseen_snapshots(problem: ss.PosingProblem, count: int, *, threads: int | None) -> ss.Snapshots:
    """Tight solutions at parameters that no sampling method uses."""
    points = np.random.default_rng([count, 77]).random((count, problem.domain.dimension))
    options = ss.SolverOptions(tolerance=10 * REFERENCE_TOLERANCE, max_iterations=5000)
    return ss.solve_snapshots(
        problem, problem.domain.from_unit(points), options=options, threads=threads
    )


def solve(problem: ss.PosingProblem, method: str, args: argparse.Namespace) -> Any:
    """The snapshots, and a function of a number of samples: seconds until they were finished."""
    wall, cpu, done = [0.0], [0.0], [0]
    begin = time.perf_counter(), time.process_time()

    def progress(state: ss.SolveProgress) -> None:
        wall.append(time.perf_counter() - begin[0])
        cpu.append(time.process_time() - begin[1])
        done.append(state.done)
        common.progress(state)

    options: dict[str, Any] = {"threads": args.threads, "progress": progress}
    if method == "greedy":
        solved = ss.greedy_snapshots(problem, args.samples, seed=args.seed, **options)
    else:
        samples = ss.sample(problem.domain, args.samples, method=method, seed=args.seed)
        solved = ss.solve_snapshots(problem, samples, **options)

    def seconds(count: int) -> dict[str, float]:
        return {
            "wall s": float(np.interp(count, done, wall)),
            "CPU s": float(np.interp(count, done, cpu)),
        }

    return solved, seconds


def errors(
    solved: ss.Snapshots, unseen: ss.Snapshots, count: int, reduced: int, *, threads: int | None
) -> dict[str, list[float]]:
    """Projection errors of unseen samples with the first samples, and errors of reduced solves."""
    problem = solved.problem
    gram = ss.SnapshotGram.of(problem)
    gram.add([*solved.displacements, *unseen.displacements])
    training = np.flatnonzero(solved.converged[:count])
    new = len(solved) + np.flatnonzero(unseen.converged)
    found = {
        f"projection, d = {d}": statistics(gram.held_out_error(training, new, d)) for d in SIZES
    }
    first = solved.select(np.arange(len(solved)) < count)
    subspace = ss.snapshot_pca(first, dimension=reduced)
    session = ss.reduce(problem, subspace, threads=threads).session()
    misses = []
    for w, row in zip(unseen.parameters, unseen.displacements, strict=True):
        session.reset()
        session.set_parameters(w)
        difference = subspace.shape(session.q) - problem.base - row
        misses.append(norm(subspace.mass, difference) / norm(subspace.mass, row))
    return {**found, f"reduced, d = {reduced}": statistics(np.array(misses))}


def norm(mass: Any, vector: np.ndarray) -> float:
    columns = vector.reshape(-1, 3)
    return float(np.sqrt(np.sum(columns * (mass @ columns))))


def statistics(values: np.ndarray) -> list[float]:
    return [float(np.median(values)), float(np.mean(values)), float(np.max(values))]


def text(value: Any) -> str:
    if isinstance(value, list):
        return " / ".join(f"{number:.4f}" for number in value)
    return f"{value:.1f}" if isinstance(value, float) else str(value)


if __name__ == "__main__":
    main()
