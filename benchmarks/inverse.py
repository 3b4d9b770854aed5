"""Factor against multigrid cycle in the seed of the solvers, on the same samples in one run.

    python benchmarks/inverse.py --problem creature:250000 spot

Both are used for every problem; the last row says which one the problem uses by default.
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

import common
import numpy as np

import snapspace as ss
from snapspace import _core as core

Rows = list[tuple[str, Any, str]]


def with_inverse(name: str, kind: core.InverseKind) -> ss.PosingProblem:
    """The problem with a system that has an inverse of this kind."""
    problem = common.read_problem(name)
    # the cached property of the problem
    problem.__dict__["system"] = core.PosingSystem(
        problem.mesh.vertices,
        problem.mesh.tets,
        problem.material.core,
        problem.pinned,
        problem.pin_weights,
        inverse=kind,
    )
    return problem


def measured(name: str, kind: core.InverseKind, samples: int) -> dict[str, Any]:
    begin = time.perf_counter()
    problem = with_inverse(name, kind)
    made = time.perf_counter() - begin
    parts = core.time_parts(problem.system, np.zeros(problem.base.size), single=True)
    begin = time.perf_counter()
    solved = common.solved(problem, ss.sample(problem.domain, samples, seed=0))
    return {
        "tets": len(problem.mesh.tets),
        "made_seconds": made,
        "lowest_eigenvalue": problem.system.lowest_eigenvalue,
        "kernel_milliseconds": 1e3 * parts.kernel_seconds,
        "solve_milliseconds": 1e3 * parts.solve_seconds,
        "evaluations": float(np.mean([report.evaluations for report in solved.reports])),
        "seconds_each": (time.perf_counter() - begin) / samples,
        "converged": int(solved.converged.sum()),
        "value": float(np.mean([report.value for report in solved.reports])),
    }


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--problem", nargs="+", default=["creature:250000"])
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--json", action="store_true")
    args = parser.parse_args()
    rows: Rows = []
    result: dict[str, Any] = {"samples": args.samples, "problems": {}}
    for name in args.problem:
        taken = common.read_problem(name).system.inverse.name
        result["problems"][name] = {"taken": taken}
        for kind in (core.InverseKind.factor, core.InverseKind.cycle):
            figures = measured(name, kind, args.samples)
            result["problems"][name][kind.name] = figures
            for figure, value in figures.items():
                rows.append((f"{name}, {kind.name}: {figure}", value, ""))
        rows.append((f"{name}: taken", taken, ""))
    common.show("inverse", rows, result, args.json)


if __name__ == "__main__":
    sys.exit(main())
