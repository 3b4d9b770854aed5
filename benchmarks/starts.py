"""Starts of samples: their errors, and the cost of solves from them, in one run.

    python benchmarks/starts.py --problem dragon --known 0 16 36 100

Starts are compared with tight solutions.
"""

from __future__ import annotations

import argparse
from typing import Any

import common
import numpy as np

import snapspace as ss
from snapspace import _core as core
from snapspace.displacements import DisplacementRows
from snapspace.mesh import mass_norms
from snapspace.snapshots.guesses import Guesses
from snapspace.snapshots.starts import interpolated_start

Rows = list[tuple[str, Any, str]]

#: Number of samples on which each kind of start is tested.
WANTED = 32


def starts(
    problem: ss.PosingProblem, samples: np.ndarray, rows: np.ndarray
) -> dict[str, np.ndarray]:
    """Starts of the last samples: the rest shape, and guesses from the samples with known rows."""
    known, wanted = range(len(rows)), range(len(rows), len(samples))
    found = {
        "rest": np.zeros((WANTED, problem.base.size)),
        "guess": problem.guesses(samples[list(wanted)]),
    }
    if len(known) > 1:
        scaled = problem.domain.scaled(samples)
        displacements = DisplacementRows(rows, problem.base.size)
        near, far = scaled[: len(rows)], scaled[len(rows) :]
        found["interpolated"] = interpolated_start(near, displacements, far)
        corrected = Guesses(problem, samples).corrected(wanted, known, displacements)
        if corrected is not None:
            found["corrected guess"] = corrected
    return found


def measured(
    problem: ss.PosingProblem, samples: np.ndarray, start: np.ndarray, exact: np.ndarray
) -> dict[str, float]:
    """The start's error, and the evaluations of a loose solve and of a settled one."""
    mass, size = problem.mass(), mass_norms(problem.mass(), exact)
    error = mass_norms(mass, start - exact) / size
    result = {"error": float(np.median(error))}
    for name, options in (
        ("loose", {"tolerance": 1e3 * problem.solving.tolerance}),
        ("settled", {"tolerance": problem.solving.tolerance, "settling": 0.01}),
    ):
        batch = problem.system.solve_fast(
            problem.inputs(samples),
            start,
            max_iterations=1000,
            threads=0,
            control=core.SolveControl(),
            single=True,
            modes=problem.solving.soft_modes(),
            **options,
        )
        result[name] = float(np.mean([report.evaluations for report in batch.reports]))
    return result


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--problem", default="dragon")
    parser.add_argument("--known", type=int, nargs="+", default=[0, 16, 36, 100])
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    problem = common.read_problem(args.problem)
    drawn = ss.sample(problem.domain, max(args.known) + WANTED, seed=0)
    exact = common.solved(problem, drawn, tolerance=1e-7, max_iterations=5000).displacements.array()
    result: dict[str, Any] = {"problem": args.problem, "known": {}}
    rows: Rows = []
    for known in args.known:
        samples = np.vstack([np.zeros(problem.parameter_count), drawn[: known + WANTED]])
        finished = np.vstack([np.zeros(problem.base.size), exact[:known]])
        here = result["known"][known] = {}
        for name, start in starts(problem, samples, finished).items():
            wanted = exact[known : known + WANTED]
            found = here[name] = measured(problem, samples[1 + known :], start, wanted)
            rows.append(
                (
                    f"{known} finished, {name}",
                    f"error {found['error']:.3f}, evaluations {found['loose']:.1f} loosely, "
                    f"{found['settled']:.1f} settled",
                    "",
                )
            )
    common.show(f"starts: {args.problem}", rows, result, args.json)


if __name__ == "__main__":
    main()
